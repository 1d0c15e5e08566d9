#pragma once

#include <abut/view.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace abut {

/// Reads a chunk by its number. Called from the thread that loads.
using ChunkSource = std::function<ViewChunk(std::uint32_t)>;

enum class ChunkState : std::uint8_t {
    absent,
    loading,
    staged,   ///< in memory, and the renderer does not have it
    resident, ///< the renderer has it
    failed,   ///< it cannot be read; it is not tried again
};

/// The states of all chunks. The thread that draws and the thread that loads share it without a
/// lock: each state is changed by one of them at a time, as ChunkLoader says.
class ChunkTable {
public:
    explicit ChunkTable(std::size_t chunks) : states_(chunks), touched_(chunks) {}

    [[nodiscard]] ChunkState state(std::uint32_t chunk) const {
        return states_[chunk].load(std::memory_order_acquire);
    }
    void set(std::uint32_t chunk, ChunkState state) {
        states_[chunk].store(state, std::memory_order_release);
    }
    /// The last frame in which the chunk was drawn, replaced or planned.
    [[nodiscard]] std::uint32_t touched(std::uint32_t chunk) const {
        return touched_[chunk].load(std::memory_order_relaxed);
    }
    void touch(std::uint32_t chunk, std::uint32_t frame) {
        touched_[chunk].store(frame, std::memory_order_relaxed);
    }
    [[nodiscard]] std::uint64_t bytes() const {
        return states_.size() * sizeof(states_[0]) + touched_.size() * sizeof(touched_[0]);
    }

private:
    std::vector<std::atomic<ChunkState>> states_;
    std::vector<std::atomic<std::uint32_t>> touched_;
};

} // namespace abut
