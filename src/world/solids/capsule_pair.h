#pragma once

#include <abut/contacts.h>

#include "geometry/rounded_box_distance.h"
#include "world/solids/known_separation.h"
#include "world/solids/write_points.h"

#include <vector>

namespace abut {

/// Appends the contact of two capsules, without ids. Returns whether they are at most the margin apart;
/// else nothing is appended.
///
/// In          a, b: in the world, each with an extent on one axis.
/// Out         separation: the direction of the gap if it is larger than the margin, or none.
/// Accuracy    the normal is that of `rounded_box_distance`.
/// Cost        about 0.2 us; no allocation.
bool contact_of_capsules(const RoundedBox& a, const RoundedBox& b, const ContactLimits& limits,
                         KnownSeparation& separation, std::vector<ContactManifold>& manifolds);

} // namespace abut
