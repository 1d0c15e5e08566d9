#pragma once

#include <abut/contacts.h>
#include <abut/model.h>
#include <abut/shapes.h>

#include "world/contacts/solid_contacts.h"

#include <cstdint>

namespace abut {

/// Names of the points of a capsule's contact with a surface.
enum class CapsulePoint : std::uint8_t { middle = 0, end_a = 1, end_b = 2 };

/// Adds the ends of a capsule on a surface to their contact, which has the deepest point. An end is added
/// if its ball is at most the margin from the surface, and the ball's normal is within 26 degrees of the
/// contact's. The deepest point is left out if an end is as deep: along a flat surface, all points of the
/// axis are.
///
/// In          the capsule in the world. manifold: normal from a to b.
/// Out         up to three points, the deepest first.
void add_capsule_ends(const Model& surface, const Transform& world_from_surface,
                      const Capsule& capsule, bool capsule_is_a, const ContactLimits& limits,
                      ContactManifold& manifold);

} // namespace abut
