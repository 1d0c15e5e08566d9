#pragma once

#include <abut/contacts.h>
#include <abut/model.h>

#include "geometry/rounded_box_distance.h"

#include <optional>

namespace abut {

/// The contact of a ball or a capsule and a surface, as far as triangles near its core tell it.
struct RoundedContact {
    double rounding = 0; ///< bounds that of the depths
    ContactManifold
        manifold; ///< without ids; without points if they are farther apart than the margin
};

/// Finds the contact of a ball or a capsule and a surface from the triangles near its core.
///
/// In          solid: in the world; a point or a segment with a radius. solid_is_a: normals point from a to
///             b.
/// Out         none if the core is not clearly on the outer side of the surface: then the depth is more than
///             the radius, and capsule_gap and ball_gap have to tell it.
/// Cost        one search of the tree, and for each triangle found one distance, or three.
std::optional<RoundedContact> rounded_on_surface(const RoundedBox& solid, const Model& surface,
                                                 const Transform& world_from_surface,
                                                 bool solid_is_a, double margin);

} // namespace abut
