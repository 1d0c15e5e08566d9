#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/penetration/deepest_point.h"
#include "rigid/solid/world_solid.h"

#include <span>

namespace abut {

/// The penetration depth of two models that interpenetrate.
struct LocalPenetration {
    double depth = 0;   ///< reached at the points below
    double at_most = 0; ///< upper bound of the depth, to rounding
    /// at_most + rounding is proven. 0 if `at_most` is a length but no bound.
    double rounding = 0;
    /// The depth of a point in a solid. Else, between open shells and for locked models, the depth is
    /// only a bound of the length of the shortest separating motion.
    bool is_in_solid = false;
    Vec3 point_a, point_b;
    Vec3 direction; ///< unit vector along which b leaves a at point_a; zero if the depth is
    TrianglePair triangles{}; ///< the triangles that hold the points
};

/// Computes the local penetration depth.
///
/// With a solid: the largest distance from the solid's surface that a point of the other surface
/// has inside the solid (of two solids, the larger of both). Between open surfaces: over all
/// crossing triangle pairs, the largest of the shortest translations that separate the two
/// triangles.
///
/// Coordinates are relative to one of the models' vertices: models that are moved together, without
/// rounding, have the same depth to the last bit.
///
/// In          all contacts; or those of a region, with the parts of the surfaces that belong to
///             it.
/// Accuracy    with a solid, `depth` is reached at point_a and point_b to rounding, and [depth,
///             at_most] encloses the true value. Otherwise it is the value of the definition, at a
///             common point.
LocalPenetration local_penetration(const WorldSolid& a, const WorldSolid& b,
                                   std::span<const Contact> contacts, const DepthSearch& options,
                                   const SurfacePart& part_a = {}, const SurfacePart& part_b = {});

/// Bounds the rounding of a distance between two points of the models, including that of the
/// points' coordinates relative to a near origin.
double depth_rounding(const WorldSolid& a, const WorldSolid& b);

/// The depth of two models that have contacts and interpenetrate: their local penetration. If that
/// is 0 because the models are only locked into each other (coplanar faces), the length of the
/// shortest separating motion found.
LocalPenetration penetration_depth(const WorldSolid& a, const WorldSolid& b,
                                   std::span<const Contact> contacts, const DepthSearch& options);
/// The length of the shortest separating motion found, as a depth at a common point.
LocalPenetration locked_depth(const WorldSolid& a, const WorldSolid& b,
                              std::span<const Contact> contacts);

} // namespace abut
