#pragma once

#include <abut/model.h>

#include "massive/work/task.h"
#include "store/model_reader.h"

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace abut {

/// A cache of models of a store's meshes, with a memory budget. Each task says when its meshes are
/// needed again. The model whose next use is farthest in the future is evicted first.
///
/// Source      [Belady 1966]. Differs: only the uses that are known when a task is handed out
///             count.
class ModelCache {
public:
    /// In          reader: must outlive the cache; budget: bytes.
    ModelCache(ModelReader& reader, std::uint64_t budget) : reader_(reader), budget_(budget) {}

    /// Returns the models of a task's meshes; missing ones are read in parallel. They stay valid
    /// until the call after the next, so that one task can be tested while the models of the next
    /// one are read. If either task is `alone`, they stay valid only until the next call.
    ///
    /// Errors      those of the store.
    std::vector<const Model*> load(const Task& task);

    [[nodiscard]] std::uint64_t loads() const { return loads_; }
    [[nodiscard]] std::uint64_t peak_bytes() const { return peak_bytes_; }

private:
    struct Entry {
        std::unique_ptr<const Model> model;
        std::uint32_t next_use = Task::kNoUse;
        std::uint64_t call = 0; ///< the last load() that needed it
    };

    void make_room(std::uint32_t unit, std::uint64_t bytes, bool alone);

    ModelReader& reader_;
    std::uint64_t budget_;
    std::unordered_map<std::int64_t, Entry> entries_; ///< by row of the mesh
    std::uint64_t call_ = 1;
    bool was_alone_ = false; ///< whether the last task was `alone`
    std::uint64_t bytes_ = 0, peak_bytes_ = 0, loads_ = 0;
};

} // namespace abut
