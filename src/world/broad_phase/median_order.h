#pragma once

#include "world/broad_phase/box_levels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// A box that is not empty, represented by its centre.
struct Middle {
    std::array<float, 3> point;
    std::uint32_t box;
};

void order_by_medians(std::vector<Middle>& middles);

/// Orders boxes so that every group of 16 consecutive boxes, counted from the first, lies close
/// together, and so does every group of 16 x 16, and so on. Empty boxes come last. Returns the
/// index of the box at each place.
///
/// In          box_at(i) returns box i as an Aabb.
/// Cost        O(n log n), in parallel. The result does not depend on the number of threads.
/// Source      k-d splits at medians [Bentley 1975] along the widest axis. Differs: cuts lie at
///             multiples of powers of 16, so that a complete 16-ary tree over the order has full
///             nodes and no links need to be stored.
template <typename BoxAt>
std::vector<std::uint32_t> median_order(std::size_t count, const BoxAt& box_at) {
    std::vector<std::uint32_t> order(count);
    std::vector<Middle> middles;
    middles.reserve(count);
    std::size_t last = count;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Aabb box = box_at(i);
        if (is_empty(box)) {
            order[--last] = i;
            continue;
        }
        Middle& middle = middles.emplace_back(Middle{{}, i});
        for (std::size_t axis = 0; axis < 3; ++axis)
            middle.point[axis] = 0.5F * box.lower[axis] + 0.5F * box.upper[axis];
    }
    order_by_medians(middles);
    std::transform(middles.begin(), middles.end(), order.begin(),
                   [](const Middle& middle) { return middle.box; });
    return order;
}

} // namespace abut
