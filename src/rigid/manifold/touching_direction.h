#pragma once

#include <abut/model.h>

#include "math/vector.h"
#include "rigid/manifold/manifold_side.h"

#include <boost/container/static_vector.hpp>
#include <optional>

// Directions of surfaces that touch, or are apart by little more than rounding. The vector between
// their closest points says nothing then; the faces and edges there do.
namespace abut {

/// Bound of the rounding of a position of either side.
double rounding_of_places(const ManifoldSide& a, const ManifoldSide& b);

/// Two triangles, their outward unit normals, and whether these tell the inside from the outside.
struct TrianglesInTouch {
    const Triangle &a, &b;
    const Vec3 &normal_a, &normal_b; ///< zero without area
    bool is_oriented_a = true, is_oriented_b = true;
};

/// A direction from a to b, as two triangles tell it, and what they share.
struct TouchingDirection {
    /// Faces that lie on each other: the area that they share, times the unit normal. Else zero.
    Vec3 area;
    /// The unit vector across the features that touch: a face, or two edges that cross. Zero if these
    /// leave it open: a vertex at a vertex or an edge, parallel edges.
    Vec3 across;
    bool in_one_plane = false; ///< to rounding
    /// The corners of the polygon that triangles in one plane share; none if they share no area.
    boost::container::static_vector<Vec3, 6> outline;
};

/// In          rounding: bounds that of a coordinate. The triangles touch, give or take some of it.
/// Out         faces that look the same way share no area, unless one is of an open surface.
TouchingDirection touching_direction(const TrianglesInTouch& triangles, double rounding);

/// The unit vector from a to b across the faces and edges at a place where two sides touch; zero if
/// nothing lies there. Points in the frame of the sides. As direction_of_touching.
Vec3 direction_at(const ManifoldSide& a, const ManifoldSide& b, const Vec3& point_a,
                  const Vec3& point_b);

/// The unit vector from a to b across the faces and edges of two models at a place where they touch.
///
/// In          point_a, point_b: of the surfaces, world frame; way: between them, from a to b; if the
///             models overlap, from b to a. distance: of the models, or their depth.
/// Out         none if the way itself tells the direction: it is clear of rounding, or no face or edge
///             lies across it. If it is zero, any direction that parts the surfaces there; if none
///             does, as in a corner, that of the largest area that they share.
/// Degenerate  a transform without an inverse: none.
/// Cost        the triangles at the place, of which at most 64 of each model count.
std::optional<Vec3> direction_of_touching(const Model& a, const Transform& world_from_a,
                                          const Model& b, const Transform& world_from_b,
                                          const Vec3& point_a, const Vec3& point_b, const Vec3& way,
                                          double distance);

} // namespace abut
