#pragma once

#include "mesh/surface_features.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The vertices around some triangles, in order, if these form a disc: connected, every side used by
/// one of them, or by two in opposite directions, with one boundary that passes no vertex twice,
/// and no hole. Empty if they do not.
///
/// Cost        O(n log n).
std::vector<std::uint32_t> disc_boundary(std::span<const IndexTriangle> triangles);

} // namespace abut
