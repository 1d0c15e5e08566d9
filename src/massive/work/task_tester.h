#pragma once

#include <abut/clash.h>
#include <abut/model.h>

#include "clash/test_pair.h"
#include "massive/work/large_meshes.h"
#include "massive/work/model_cache.h"
#include "massive/work/task.h"
#include "store/model_reader.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace abut {

/// Does tasks: reads the meshes and parts that a task needs, and tests its pairs.
class TaskTester {
public:
    /// In          store: must outlive this object; models: of the store; budget: bytes of models in
    ///             memory; blocks_budget: bytes of mesh blocks in memory; hierarchies_room: bytes
    ///             of built hierarchies that wait to be stored, 0 if none is stored.
    TaskTester(StoreFile& store, const std::vector<ModelRow>& models, std::uint64_t budget,
               std::uint64_t blocks_budget, std::uint64_t hierarchies_room = 0);

    /// A task with the data that it needs, valid until the load after the next.
    struct Loaded {
        Task task;
        std::vector<const Model*> models;      ///< of the task's meshes
        std::vector<const ModelBlocks*> large; ///< of the task's large meshes
        int threads = 1;                       ///< at most, for the pairs with a large mesh
        std::vector<PartRow> parts;            ///< store rows of the task's parts
    };
    /// Errors      those of the store.
    Loaded load(Task task);

    /// Tests all pairs of a task.
    ///
    /// In          on_pair: called after each pair, from any thread; an exception that it throws
    ///             ends the test.
    TaskResult test(const Loaded& loaded, const std::function<void()>& on_pair) const;

    /// Returns the hierarchies that were built since the last call and are to be stored.
    std::vector<HierarchyRow> take_built() { return reader_.take_built(); }

    /// The counters of this worker so far, without units and pairs.
    [[nodiscard]] OutOfCoreCounters::Worker figures() const;

private:
    PairAnswer test(const Loaded& loaded, const Task::Pair& pair) const;

    StoreFile& store_;
    std::vector<std::string> files_; ///< by model
    ModelReader reader_;
    ModelCache cache_;
    LargeMeshes large_;
    std::uint64_t read_before_;
};

} // namespace abut
