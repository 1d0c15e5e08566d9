#pragma once

#include <abut/mesh.h>

#include <cstdint>

/// Closed curved bodies of any number of triangles.
namespace abut::scenes {

/// The unit sphere: an octahedron whose faces are divided evenly and pushed out.
///
/// In          8 n^2 triangles are made, n at least 1, as near to what is asked for as that comes.
Mesh sphere(std::uint32_t triangles);

/// A sphere with bumps of many sizes, about 1 across. Triangles as those of `sphere`.
Mesh boulder(std::uint32_t triangles, std::uint64_t seed = 1);

/// A trefoil knot of rippled tube, about 1 across.
///
/// In          at least 18 triangles are made, and about as many as asked for.
Mesh knot(std::uint32_t triangles);

} // namespace abut::scenes
