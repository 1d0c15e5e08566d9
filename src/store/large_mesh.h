#pragma once

#include <abut/progress.h>

#include "io/scene_source.h"
#include "store/store_writer.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// What import_large_mesh finds of a mesh and of the parts that show it.
struct LargeMesh {
    std::int64_t mesh = 0;   ///< in the store
    std::vector<Box3> boxes; ///< of the parts in the world
    bool has_area = false;   ///< of a triangle of one of the parts
};

/// Brings a mesh into the store that does not fit into the memory: vertices and triangles go through
/// temporary files, where they are joined, numbered and put into spatial order by sorting.
///
/// In/out      placements: world_from_mesh of each part that shows it. The mesh in the store is the
///             same, bit for bit and block for block, as encode_mesh would make it.
/// In          a source whose coordinates are floats.
/// Errors      Fault bad_mesh; Error{cannot_write} if the disk is full; Error{interrupted}.
/// Cost        O(n log n); about 100 bytes of disk a triangle while it runs.
LargeMesh import_large_mesh(const SceneSource& source, std::uint32_t mesh,
                            std::span<const Transform> placements, std::uint64_t memory,
                            const Progress& progress, StoreWriter& writer);

} // namespace abut
