#pragma once

#include <abut/contacts.h>
#include <abut/model.h>
#include <abut/shapes.h>

namespace abut {

/// Names of the points of a capsule's contact with a surface.
enum class CapsulePoint : std::uint8_t { middle = 0, end_a = 1, end_b = 2 };

/// Adds the ends of a capsule that rests on a surface to the contact of both, which has the deepest point.
/// An end counts if its ball is at most the margin apart, along about the contact's normal. The deepest
/// point goes where an end is as deep: along a flat surface, all points of the axis are.
///
/// In          the capsule in the world. manifold: normal from a to b.
/// Out         up to three points, the deepest first.
void add_capsule_ends(const Model& surface, const Transform& world_from_surface,
                      const Capsule& capsule, bool capsule_is_a, double margin,
                      ContactManifold& manifold);

} // namespace abut
