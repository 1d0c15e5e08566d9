#pragma once

#include <abut/view.h>

#include <array>
#include <cstdint>
#include <vector>

namespace abut {

/// Consecutive triangles of a chunk, which mostly lie together. They are drawn or left out together.
struct TriangleRun {
    std::array<float, 3> lower{}, upper{}; ///< box, in the frame of the chunk
    std::uint32_t first = 0, end = 0;      ///< in ViewChunk::indices
};

/// Divides the triangles of a chunk, in their order. Triangles of closed surfaces and others are in
/// different runs.
std::vector<TriangleRun> triangle_runs(const ViewChunk& chunk);

} // namespace abut
