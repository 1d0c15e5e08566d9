#pragma once

#include "math/vector.h"
#include "mesh/surface_features.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// For each triangle of a convex surface a number that it shares with those that form one flat face
/// with it: 0, 1, ... in the order of their first triangles.
///
/// In          a closed surface around a volume.
/// Accuracy    exact: faces that are flat to rounding only stay apart.
std::vector<std::uint32_t> coplanar_groups(std::span<const Vec3> points,
                                           std::span<const IndexTriangle> triangles);

} // namespace abut
