#pragma once

#include <abut/mesh.h>

#include <cstdint>
#include <span>

namespace abut {

/// A mesh from the arrays of another program: x, y, z of each vertex, then three vertices a triangle.
///
///     const Model model(make_mesh(positions, indices));
///
/// In/out      `positions` has three numbers a vertex, `indices` three a triangle, counted from 0. A
///             vector or an array converts to the span. Both are copied; floats become the doubles
///             that they are.
/// Errors      Error{bad_mesh} if a length is no multiple of three or an index is out of range; the
///             message names the place. Coordinates are checked by whatever takes the mesh.
/// Cost        linear.
Mesh make_mesh(std::span<const double> positions, std::span<const std::uint32_t> indices);
Mesh make_mesh(std::span<const double> positions, std::span<const std::int32_t> indices);
Mesh make_mesh(std::span<const float> positions, std::span<const std::uint32_t> indices);
Mesh make_mesh(std::span<const float> positions, std::span<const std::int32_t> indices);

} // namespace abut
