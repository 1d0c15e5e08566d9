#pragma once

#include "store/database/level_table.h"
#include "store/database/store_file.h"
#include "view/levels/level_plan.h"
#include "view/levels/quantised_chunk.h"

#include <span>
#include <vector>

namespace abut {

/// A chunk on its way into the store.
struct MadeChunk {
    LevelChunkRow row;
    std::vector<std::byte> data;
};

/// A child of a node whose chunk is made.
struct ChildSurface {
    LevelSurface surface;
    Box3 box; ///< of the surface and of what it stands for
};

/// Full detail of some parts.
///
/// In          origin: the positions are relative to it; slice: see PlannedNode.
MadeChunk make_leaf(StoreFile& store, std::span<const LevelItem> items, const Vec3& origin,
                    std::uint32_t slice, std::uint32_t slices);

/// The levels of a mesh that parts share, finest first, relative to `centre`.
std::vector<MadeChunk> make_mesh_levels(StoreFile& store, std::int64_t mesh, const Vec3& centre);

/// A chunk as the child of another one.
///
/// Errors      Fault malformed if the data are not those of a chunk.
ChildSurface chunk_surface(const LevelChunkRow& row, std::span<const std::byte> data);
/// Full detail of an instance.
ChildSurface instance_surface(StoreFile& store, const LevelItem& item, const Vec3& origin);

/// Merges children and simplifies them.
MadeChunk make_parent(std::vector<ChildSurface> children);

} // namespace abut
