#pragma once

#include <abut/model.h>

#include "massive/work_piece.h"
#include "store/model_reader.h"

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace abut {

/// Models of a store's meshes, as many as a number of bytes allows. Each piece of work says when its
/// meshes are used again; what is used again the latest goes first.
///
/// Source      [Belady 1966]. Differs: only the uses that are known when a piece is handed out count.
class ModelCache {
public:
    /// In          reader: must outlive the cache.
    ModelCache(ModelReader& reader, std::uint64_t budget) : reader_(reader), budget_(budget) {}

    /// The models of a piece's meshes, read in parallel. They stay until the call after
    /// the next, so that a piece may be tested while the next one's models come; only until the next, if
    /// either is `alone`.
    ///
    /// Errors      those of the store.
    std::vector<const Model*> load(const WorkPiece& piece);

    [[nodiscard]] std::uint64_t loads() const { return loads_; }
    [[nodiscard]] std::uint64_t peak_bytes() const { return peak_bytes_; }

private:
    struct Entry {
        std::unique_ptr<const Model> model;
        std::uint32_t next_use = WorkPiece::kNoUse;
        std::uint64_t call = 0; ///< the last load() that wanted it
    };

    void make_room(std::uint32_t unit, std::uint64_t bytes, bool alone);

    ModelReader& reader_;
    std::uint64_t budget_;
    std::unordered_map<std::int64_t, Entry> entries_; ///< by mesh
    std::uint64_t call_ = 1;
    bool was_alone_ = false; ///< the last piece
    std::uint64_t bytes_ = 0, peak_bytes_ = 0, loads_ = 0;
};

} // namespace abut
