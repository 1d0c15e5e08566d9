#pragma once

#include <array>
#include <assimp/vector3.h>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A polygon of n vertices as exactly n - 2 triangles, by ear clipping in the plane of its mean
/// normal.
///
/// Assimp's own step gives up on polygons that are not simple and loses a part of them; this one
/// never does.
///
/// In/out      corners: n >= 3 indices in range of positions; appends to triangles, in the
///             polygon's orientation. Degenerate  where no ear is left (self-intersecting, flat to
///             a line) the first corner is cut off.
/// Cost        O(n^2) for usual polygons, O(n^3) at worst.
void triangulate(std::span<const std::uint32_t> corners, const aiVector3D* positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

} // namespace abut
