#pragma once

#include <abut/progress.h>

#include "io/scene/scene_source.h"
#include "store/import/store_writer.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// The result of import_large_mesh: a mesh, and the parts that show it.
struct LargeMesh {
    std::int64_t mesh = 0;   ///< number in the store
    std::vector<Box3> boxes; ///< of the parts, in the world
    bool has_area = false;   ///< whether a triangle of some part has an area
};

/// Imports a mesh that does not fit into memory. Its vertices and triangles go through temporary
/// files, where sorting joins them, numbers them and brings them into spatial order.
///
/// In/out      placements: world_from_mesh of each part that shows the mesh. The mesh in the store
///             is the same, bit for bit and block for block, as encode_mesh would make it.
/// In          a source whose coordinates are floats.
/// Errors      Fault bad_mesh; Error{cannot_write} if the disk is full; Error{interrupted}.
/// Cost        O(n log n); about 100 bytes of temporary files per triangle.
LargeMesh import_large_mesh(const SceneSource& source, std::uint32_t mesh,
                            std::span<const Transform> placements, std::uint64_t memory,
                            const Progress& progress, StoreWriter& writer);

} // namespace abut
