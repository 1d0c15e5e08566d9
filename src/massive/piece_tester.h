#pragma once

#include <abut/clash.h>
#include <abut/model.h>

#include "massive/large_meshes.h"
#include "massive/model_cache.h"
#include "massive/rule_table.h"
#include "massive/work_piece.h"
#include "store/model_reader.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// Does pieces of work: brings what they need into memory, tests their pairs.
class PieceTester {
public:
    /// In          models: of the store; budget: bytes of models in memory; blocks_budget: of blocks of
    ///             large meshes; hierarchies_room: of hierarchies that are to be kept. Store and
    ///             options must outlive it.
    PieceTester(StoreFile& store, const ClashOptions& options, const std::vector<ModelRow>& models,
                std::uint64_t budget, std::uint64_t blocks_budget,
                std::uint64_t hierarchies_room = 0);

    /// A piece with what it needs, valid until the load after the next.
    struct Loaded {
        WorkPiece piece;
        std::vector<const Model*> models;       ///< of the piece's meshes
        std::vector<const ModelBlocks*> large;  ///< and of its large ones
        int threads = 1;                        ///< that its large pairs have room for
        std::vector<PartRow> parts;             ///< of the piece's parts
        std::unique_ptr<const RuleTable> rules; ///< of the same
    };
    /// Errors      those of the store.
    Loaded load(WorkPiece piece);

    /// In          on_pair: called after each pair, from any thread; what it throws ends the test.
    PieceResult test(const Loaded& loaded, const std::function<void()>& on_pair) const;

    /// Hierarchies that were built since the last call, and are to be kept.
    std::vector<HierarchyRow> take_built() { return reader_.take_built(); }

    /// What it did so far, but for units and pairs.
    [[nodiscard]] OutOfCoreCounters::Worker figures() const;

private:
    std::optional<Clash> test_pair(const Loaded& loaded, const WorkPiece::Pair& pair) const;

    StoreFile& store_;
    const ClashOptions& options_;
    std::vector<std::string> files_; ///< of the models
    ModelReader reader_;
    ModelCache cache_;
    LargeMeshes large_;
    std::uint64_t read_before_;
};

} // namespace abut
