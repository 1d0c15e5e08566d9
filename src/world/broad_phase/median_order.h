#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// A box, represented by its centre.
struct Middle {
    std::array<float, 3> point;
    std::uint32_t box;
};

/// Orders boxes so that every group of 16 consecutive boxes, counted from the first, lies close
/// together, and so does every group of 16 x 16, and so on.
///
/// Cost        O(n log n), in parallel. The result does not depend on the number of threads.
/// Source      k-d splits at medians [Bentley 1975] along the widest axis. Differs: cuts lie at
///             multiples of powers of 16, so that a complete 16-ary tree over the order has full
///             nodes and no links need to be stored.
void order_by_medians(std::vector<Middle>& middles);

} // namespace abut
