#pragma once

#include <abut/view.h>

#include <array>
#include <cstdint>
#include <vector>

namespace abut {

/// Moves the triangles of closed surfaces to the front, in their order, and returns their number.
///
/// A surface is a set of triangles of one part that are connected through positions. It is closed if
/// each edge is used as often in one direction as in the other, and the volume that its triangles
/// enclose is positive. A line from outside of its box then meets as many fronts as backs. So if only
/// the fronts are drawn, the surface has no holes, even if it penetrates itself.
///
/// Cost        O(n log n)
std::uint32_t put_closed_first(std::vector<std::array<ChunkVertex, 3>>& triangles);

} // namespace abut
