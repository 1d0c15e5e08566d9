#pragma once

#include <abut/contacts.h>
#include <abut/model.h>

#include "geometry/rounded_box_distance.h"

#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <optional>

namespace abut {

/// The contacts of a ball or a capsule and a surface, as far as triangles near its core tell them: one for
/// each wall that it touches, the nearest wall first.
struct RoundedContacts {
    static constexpr std::size_t kMostWalls = 4;
    double rounding = 0; ///< bounds that of the depths
    /// Without ids and region numbers; empty if they are farther apart than the margin.
    boost::container::static_vector<ContactManifold, kMostWalls> manifolds;
};

/// Finds the contacts of a ball or a capsule and a surface from the triangles near its core.
///
/// A wall is a place of the surface that is nearest to the core, among the triangles that meet there. It
/// counts if it rises by more than 2^-10 of the radius over the planes through the places of the other
/// walls, across their normals: by more than 2.5 degrees, for a floor that rises under a ball. What lies
/// lower cannot be met by a ball or capsule that the other walls hold. Of more than four walls those that
/// meet the body, and the most different directions, are kept.
///
/// In          solid: in the world; a point or a segment with a radius. solid_is_a: normals point from a to
///             b.
/// Out         none if the core is not clearly on the outer side of the surface: then the depth is more than
///             the radius, and capsule_gap and ball_gap have to tell it.
/// Cost        one search of the tree, and for each triangle found one distance, or three.
std::optional<RoundedContacts> rounded_on_surface(const RoundedBox& solid, const Model& surface,
                                                  const Transform& world_from_surface,
                                                  bool solid_is_a, double margin);

} // namespace abut
