#pragma once

#include <abut/mesh.h>

#include <cstdint>
#include <span>

namespace abut {

/// Makes a mesh from the arrays of another program: x, y, z of each vertex, then three vertex
/// indices for each triangle.
///
///     const Model model(make_mesh(positions, indices));
///
/// In/out      `positions` has three numbers a vertex, `indices` three a triangle, counted from 0.
///             A vector or an array converts to the span. Both are copied; floats are converted
///             exactly to doubles.
/// Errors      Error{bad_mesh}, naming the place, if a length is not a multiple of three or an
///             index is out of range. The coordinates are checked by the function that takes the
///             mesh.
/// Cost        linear.
Mesh make_mesh(std::span<const double> positions, std::span<const std::uint32_t> indices);
Mesh make_mesh(std::span<const double> positions, std::span<const std::int32_t> indices);
Mesh make_mesh(std::span<const float> positions, std::span<const std::uint32_t> indices);
Mesh make_mesh(std::span<const float> positions, std::span<const std::int32_t> indices);

} // namespace abut
