#pragma once

#include <abut/contacts.h>

#include "rigid/model/placed_model.h"
#include "world/contacts/solid_contacts.h"
#include "world/narrow_phase/body.h"

namespace abut {

/// The different vertices of a surface that are at most `height` over a plane, as corners relative to
/// `origin`. Those of no triangle do not count.
ContactFace corners_over_plane(const PlacedModel& surface, const PlaneShape& plane, double height,
                               const Vec3& origin);

/// Sets the points of the contact of a body and a half-space: of its corners that are at most the margin
/// over the plane, those that four_points chooses.
///
/// In          corners: relative to the deepest point. manifold: with this point, and the normal from a to
///             b. It keeps its depth and status.
void set_plane_corners(const ContactFace& corners, bool body_is_a, const PlaneShape& plane,
                       const ContactLimits& limits, ContactManifold& manifold);

} // namespace abut
