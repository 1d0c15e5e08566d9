#pragma once

#include <abut/clash.h>
#include <abut/scene.h>
#include <abut/store_clash.h>

#include "massive/stored_parts.h"
#include "massive/work_units.h"
#include "store/hierarchy_table.h"

#include <cstdint>
#include <vector>

namespace abut {

/// A unit of work as it is handed out: whoever does it needs the store, but no tables of parts.
struct WorkPiece {
    struct MeshUse {
        std::int64_t mesh = 0;      ///< row of the store
        std::uint64_t bytes = 0;    ///< of a Model of it, estimated
        std::uint32_t next_use = 0; ///< the next unit that needs it, as far as is known; or kNoUse
    };
    struct PartUse {
        std::int64_t row = 0;    ///< of the store
        std::uint32_t mesh = 0;  ///< index in meshes, and from their number on in large
        std::uint32_t model = 0; ///< index in the store's models
    };
    struct Pair {
        std::uint32_t a = 0, b = 0; ///< indices in parts
    };
    static constexpr std::uint32_t kNoUse = UINT32_MAX;

    std::uint32_t unit = 0; ///< which of the plan
    bool alone = false;     ///< no other piece fits into the memory beside it
    std::vector<MeshUse> meshes;
    std::vector<std::int64_t>
        large; ///< rows of large meshes: their blocks come as they are asked for
    std::vector<PartUse> parts;
    std::vector<Pair> pairs; ///< in the order of the unit
    /// Indices of the pairs that have a large mesh: those that lie together one after the other.
    std::vector<std::uint32_t> large_pairs;
};

/// All but the meshes' next uses, which kNoUse stands for.
WorkPiece make_piece(const StoredParts& stored, const std::vector<WorkUnit>& units,
                     std::size_t unit);

/// What was found in a piece.
struct PieceResult {
    struct Found {
        std::uint32_t pair = 0; ///< index in the piece's pairs
        Clash clash;            ///< without model and part
    };
    struct Named {
        std::int64_t row = 0; ///< of the store
        Part part;            ///< id, name and type
    };

    std::uint32_t unit = 0;
    std::uint32_t from = 0;     ///< rank of the worker; filled in by who receives it
    std::uint64_t pairs = 0;    ///< tested
    std::vector<Found> clashes; ///< in the order of the pairs
    std::vector<Named> named;   ///< the parts that clash, each once
    /// Built for this piece or the next, to be kept. They stay in the process that built them.
    std::vector<HierarchyRow> hierarchies;
    OutOfCoreCounters::Worker worker; ///< so far, without units and pairs
};

} // namespace abut
