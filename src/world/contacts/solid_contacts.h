#pragma once

#include <abut/contacts.h>

#include "geometry/rounded_box_distance.h"
#include "world/contacts/contact_candidates.h"
#include "world/contacts/contact_face.h"
#include "world/solids/known_separation.h"
#include "world/solids/write_points.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Appends a manifold with normal and points from the corners of the region in which two faces lie over
/// each other.
///
/// In          depth: of the two solids along the frame's normal. frame: the faces are relative to
///             its origin.
/// Out         false, and nothing is appended, if no corner has that depth. Then the solids
///             are apart and nearer along another direction, or the faces do not hold the deepest
///             points.
bool set_corners(const ContactFace& a, const ContactFace& b, const ContactFrame& frame,
                 double depth, const ContactLimits& limits,
                 std::vector<ContactManifold>& manifolds);

/// As `set_corners`, with the witness points of the two solids among the corners.
void set_corners_and_witness(const ContactFace& a, const ContactFace& b, const ContactFrame& frame,
                             const SolidGap& witness, const ContactLimits& limits,
                             std::vector<ContactManifold>& manifolds);

/// The contact of two rounded boxes, of which only those without extent on two axes have a radius.
/// Appends it, without ids, and returns true if they are at most the margin apart.
///
/// In          last: the names of points of the last step.
/// Out         separation: what separates two boxes or two capsules, or nothing.
/// Accuracy    the normal is that of `rounded_box_distance`.
bool rounded_box_contact(const RoundedBox& a, const RoundedBox& b, double margin,
                         std::span<const std::uint64_t> last, KnownSeparation& separation,
                         std::vector<ContactManifold>& manifolds);

} // namespace abut
