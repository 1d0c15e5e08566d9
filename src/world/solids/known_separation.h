#pragma once

#include "geometry/least_box_overlap.h"
#include "geometry/rounded_box_distance.h"

#include <cstddef>
#include <cstdint>

namespace abut {

/// The half axis of a segment: of a box with an extent on one axis.
struct HalfSegment {
    std::size_t number; ///< of the axis that has an extent
    Vec3 half;          ///< from the middle to the end

    explicit HalfSegment(const RoundedBox& box)
        : number(box.half[0] > 0   ? 0
                 : box.half[1] > 0 ? 1
                                   : 2),
          half(box.half[number] * box.axis[number]) {}
};

/// Whether the box has an extent on one axis only.
inline bool is_segment(const RoundedBox& box) {
    return (box.half[0] > 0) + (box.half[1] > 0) + (box.half[2] > 0) == 1;
}

/// What separated two boxes or two capsules at the last query. It is tried first: it can only prove what a
/// search from scratch would find, too, so that results do not depend on earlier queries.
///
/// Of one pair of solids, whose kinds do not change.
struct KnownSeparation {
    std::uint8_t axis = kNoAxis; ///< of two boxes: LeastOverlap::axis
    Vec3 direction; ///< of two capsules: a unit vector from a to b; zero if none is known

    /// Exchanges a and b.
    void exchange() { axis = exchanged_axis(axis), direction = -direction; }
};

/// Whether a known separation proves two solids farther apart than a distance; false if none is known.
///
/// Accuracy    false if they are farther apart by less than 2^-30 of their sizes, or if the edges of a
///             cross product are nearly parallel.
/// Cost        a tenth of a search.
bool is_apart(const KnownSeparation& known, const RoundedBox& a, const RoundedBox& b,
              double distance);

} // namespace abut
