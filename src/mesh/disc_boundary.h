#pragma once

#include "mesh/representatives.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The vertices around some triangles of a surface, in order, if these form a disc: connected, every side used by
/// one of them, or by two in opposite directions, with one boundary that passes no vertex twice,
/// and no hole. Empty if they do not.
///
/// Cost        O(n log n).
std::vector<std::uint32_t> disc_boundary(const SurfaceView& surface,
                                         std::span<const std::uint32_t> triangles);

} // namespace abut
