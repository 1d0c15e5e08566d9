#pragma once

#include <abut/contacts.h>

#include "geometry/rounded_box_distance.h"
#include "world/contacts/contact_candidates.h"
#include "world/contacts/contact_face.h"

#include <cstdint>
#include <span>

namespace abut {

/// What decides which candidates become contact points.
struct ContactLimits {
    double margin = 0;                     ///< candidates whose gap is larger are left out
    double rounding = 0;                   ///< error bound of a depth
    std::span<const std::uint64_t> last{}; ///< names of points of the last step
};

/// Writes the candidates that are within the margin, at most four, and the frame's normal. The region
/// becomes 0, the status exact.
void write_points(ContactCandidates& candidates, const ContactFrame& frame,
                  const ContactLimits& limits, ContactManifold& manifold);

/// Sets normal and points of a manifold from the corners of the region in which two faces lie over
/// each other.
///
/// In          depth: of the two solids along the frame's normal. frame: the faces are relative to
///             its origin.
/// Out         false, and the manifold is unchanged, if no corner has that depth. Then the solids
///             are apart and nearer along another direction, or the faces do not hold the deepest
///             points.
bool set_corners(const ContactFace& a, const ContactFace& b, const ContactFrame& frame,
                 double depth, const ContactLimits& limits, ContactManifold& manifold);

/// As `set_corners`, with the witness points of the two solids among the corners.
void set_corners_and_witness(const ContactFace& a, const ContactFace& b, const ContactFrame& frame,
                             const SolidGap& witness, const ContactLimits& limits,
                             ContactManifold& manifold);

/// The contact of two rounded boxes, of which only those without extent on two axes have a radius.
/// Returns whether they are at most the margin apart. Ids are not set.
///
/// In          last: the names of points of the last step.
/// Accuracy    the normal is that of `rounded_box_distance`.
bool rounded_box_contact(const RoundedBox& a, const RoundedBox& b, double margin,
                         std::span<const std::uint64_t> last, ContactManifold& manifold);

} // namespace abut
