#pragma once

#include <abut/contacts.h>

#include "geometry/rounded_box_distance.h"
#include "world/solids/known_separation.h"
#include "world/solids/write_points.h"

#include <cstdint>
#include <vector>

namespace abut {

/// What the axis on which two boxes overlap least tells about their contact.
enum class BoxContact : std::uint8_t {
    apart,   ///< the boxes are farther apart than the margin
    written, ///< a manifold has been appended
    unknown, ///< the boxes may be nearest along another direction
};

/// The contact of two boxes along the axis on which they overlap least. Ids are not set.
///
/// In          a, b: in the world, with an extent on each axis and without a radius.
/// Out         a manifold is appended only if it is written. separation: an axis that separates the
///             boxes, or none.
/// Cost        about 0.3 us; no allocation.
/// Source      separating axes [Gottschalk, Lin, Manocha 1996]; [Sutherland, Hodgman 1974].
BoxContact contact_of_boxes(const RoundedBox& a, const RoundedBox& b, const ContactLimits& limits,
                            KnownSeparation& separation, std::vector<ContactManifold>& manifolds);

/// Whether the box has an extent on each axis and no radius.
inline bool is_plain_box(const RoundedBox& box) {
    return box.half[0] > 0 && box.half[1] > 0 && box.half[2] > 0 && box.radius == 0;
}

} // namespace abut
