#pragma once

#include "store/database/level_table.h"
#include "view/levels/level_items.h"
#include "view/levels/level_plan.h"
#include "view/levels/tree_codec.h"

#include <cstdint>
#include <vector>

namespace abut {

/// The tree of a plan whose chunks are stored.
///
/// In          rows: by node, unset for instances; mesh_rows: by shared mesh, finest level first.
LevelTree make_tree(StoreFile& store, const LevelItems& items,
                    const std::vector<PlannedNode>& nodes, const std::vector<LevelChunkRow>& rows,
                    const std::vector<std::vector<LevelChunkRow>>& mesh_rows);

} // namespace abut
