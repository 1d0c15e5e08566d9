#pragma once

#include <abut/types.h>

#include "core/hash.h"
#include "store/database/store_file.h"
#include "view/levels/level_plan.h"

#include <cstdint>
#include <vector>

namespace abut {

/// A mesh that several parts share and that is drawn by instances.
struct SharedMesh {
    std::int64_t mesh = 0;
    Hash128 key;
    Vec3 centre; ///< of its box; the frame of its chunks has its origin there
};

/// What the levels of a store are made of.
struct LevelItems {
    Vec3 origin;
    std::vector<LevelItem> items;
    std::vector<SharedMesh> shared;
    std::vector<std::int64_t> parts; ///< rows, ascending
    std::uint64_t geometry_bytes = 0;
};

/// Lists the parts of a store that have triangles.
///
/// In          memory: bytes that the list may take.
/// Errors      Error{bad_argument} if they do not fit; Error{unsupported} if the parts are beyond
///             1e30 metres.
LevelItems list_level_items(StoreFile& store, std::uint64_t memory);

} // namespace abut
