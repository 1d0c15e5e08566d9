#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// A box by its middle.
struct Middle {
    std::array<float, 3> point;
    std::uint32_t box;
};

/// Puts boxes in an order of which every 16 successive ones, counted from the first, are near each
/// other, and every 16 times 16, and so on.
///
/// Cost        O(n log n), in parallel. The result does not depend on the number of threads.
/// Source      k-d splits at medians [Bentley 1975] along the widest axis. Differs: the cuts lie at
///             multiples of powers of 16, so that a complete 16-ary tree over the order has full
///             nodes, and no tree need be stored.
void order_by_medians(std::vector<Middle>& middles);

} // namespace abut
