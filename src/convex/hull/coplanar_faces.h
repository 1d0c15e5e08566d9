#pragma once

#include "math/vector.h"
#include "mesh/surface_features.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Numbers the flat faces of a convex surface. Returns for each triangle the number of its face: 0,
/// 1, ... in the order of the faces' first triangles.
///
/// In          a closed surface around a volume.
/// Accuracy    exact: faces that are coplanar only to rounding are separate.
std::vector<std::uint32_t> coplanar_groups(std::span<const Vec3> points,
                                           std::span<const IndexTriangle> triangles);

} // namespace abut
