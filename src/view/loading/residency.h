#pragma once

#include "view/levels/level_tree.h"
#include "view/loading/chunk_table.h"

#include <cstdint>
#include <vector>

namespace abut {

/// The chunks that the renderer has, within its memory. The least recently touched are dropped
/// first.
class Residency {
public:
    /// In          tree, table: must outlive this object; memory: bytes.
    Residency(const LevelTree& tree, ChunkTable& table, std::uint64_t memory);

    /// Begins a frame: what it touches stays.
    void begin_frame(std::uint32_t frame);
    /// Drops chunks that were not touched since frame `since` until there is room for `bytes`.
    /// Returns the room that there is then.
    std::uint64_t make_room(std::uint64_t bytes, std::uint32_t since);
    /// Adds a chunk that has become resident. There must be room for it.
    void add(std::uint32_t chunk);

    /// Chunks that were dropped, until they are taken.
    [[nodiscard]] std::vector<std::uint32_t>& drops() { return drops_; }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t peak_bytes() const { return peak_bytes_; }
    [[nodiscard]] std::uint64_t own_bytes() const;

private:
    [[nodiscard]] bool is_before(std::uint32_t a, std::uint32_t b) const;
    void order_candidates();

    const LevelTree& tree_;
    ChunkTable& table_;
    std::uint64_t memory_, bytes_ = 0, peak_bytes_ = 0;
    std::uint32_t frame_ = 0;
    std::vector<std::uint32_t> residents_; ///< the first ones are `candidates_`, a heap
    std::size_t candidates_ = 0;
    bool has_candidates_ = false;      ///< `candidates_` is of this frame
    std::vector<std::uint32_t> depth_; ///< by chunk: a number greater than those of its ancestors
    std::vector<std::uint32_t> drops_;
};

} // namespace abut
