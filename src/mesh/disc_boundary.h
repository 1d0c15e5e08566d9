#pragma once

#include "mesh/representative_triangles.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The boundary vertices, in order, of triangles that form a disc; empty if they form none. In a
/// disc, the triangles are connected. Each edge is used by one triangle, or by two in opposite
/// directions. There is no hole, and the one boundary visits no vertex twice.
///
/// Cost        O(n log n).
std::vector<std::uint32_t> disc_boundary(const SurfaceView& surface,
                                         std::span<const std::uint32_t> triangles);

} // namespace abut
