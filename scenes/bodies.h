#pragma once

#include <abut/mesh.h>

#include <cstdint>

/// Closed curved surfaces with any number of triangles.
namespace abut::scenes {

/// The unit sphere: an octahedron whose faces are subdivided evenly and projected outward.
///
/// In          triangles: the result has 8 n^2 triangles, for the n >= 1 that comes closest to
///             this.
Mesh sphere(std::uint32_t triangles);

/// A sphere with bumps of many sizes, about 1 across. The number of triangles is as for `sphere`.
Mesh boulder(std::uint32_t triangles, std::uint64_t seed = 1);

/// A trefoil knot of rippled tube, about 1 across.
///
/// In          triangles: the result has about this number, and at least 18.
Mesh knot(std::uint32_t triangles);

} // namespace abut::scenes
