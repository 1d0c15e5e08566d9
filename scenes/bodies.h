#pragma once

#include <abut/mesh.h>

#include <cstdint>

/// Closed curved bodies of any number of triangles, about 1 across, for queries on large meshes.
namespace abut::scenes {

/// A sphere with bumps of many sizes: an octahedron whose faces are divided evenly and pushed out.
///
/// In          at least 8 triangles are made, and about as many as asked for.
Mesh boulder(std::uint32_t triangles, std::uint64_t seed = 1);

/// A trefoil knot of rippled tube.
///
/// In          at least 18 triangles are made, and about as many as asked for.
Mesh knot(std::uint32_t triangles);

} // namespace abut::scenes
