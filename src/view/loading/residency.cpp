#include "view/loading/residency.h"

#include <algorithm>
#include <utility>

namespace abut {

Residency::Residency(const LevelTree& tree, ChunkTable& table, std::uint64_t memory)
    : tree_(tree), table_(table), memory_(memory), depth_(tree.chunks.size()) {
    residents_.reserve(tree.chunks.size());
    // Nodes come after their parents. The levels of meshes replace nodes, and each other in order.
    std::uint32_t number = 0;
    for (const LevelNode& node : tree.nodes) {
        if (node.chunk != kNoChunk)
            depth_[node.chunk] = number;
        ++number;
    }
    for (const LevelMesh& mesh : tree.meshes)
        for (std::uint32_t level = 0; level < mesh.levels; ++level)
            depth_[tree.mesh_levels[mesh.first_level + level].chunk] = number + level;
}

void Residency::begin_frame(std::uint32_t frame) {
    frame_ = frame;
    has_candidates_ = false;
}

/// Whether a is dropped before b.
bool Residency::is_before(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t used_a = table_.touched(a), used_b = table_.touched(b);
    if (used_a != used_b)
        return used_a < used_b;
    return depth_[a] != depth_[b] ? depth_[a] > depth_[b] : a > b;
}

/// Makes a heap of the chunks that this frame does not use.
void Residency::order_candidates() {
    has_candidates_ = true;
    const auto end = std::partition(residents_.begin(), residents_.end(), [&](std::uint32_t chunk) {
        return table_.touched(chunk) < frame_;
    });
    candidates_ = static_cast<std::size_t>(end - residents_.begin());
    std::make_heap(residents_.begin(), end,
                   [&](std::uint32_t a, std::uint32_t b) { return is_before(b, a); });
}

std::uint64_t Residency::make_room(std::uint64_t bytes, std::uint32_t since) {
    if (bytes_ + bytes <= memory_)
        return memory_ - bytes_;
    if (!has_candidates_)
        order_candidates();
    while (bytes_ + bytes > memory_ && candidates_ > 0) {
        const std::uint32_t chunk = residents_.front();
        if (table_.touched(chunk) >= since)
            break;
        const auto end = residents_.begin() + static_cast<std::ptrdiff_t>(candidates_);
        std::pop_heap(residents_.begin(), end,
                      [&](std::uint32_t a, std::uint32_t b) { return is_before(b, a); });
        --candidates_;
        // The last candidate and the last resident fill the gaps.
        residents_[candidates_] = residents_.back();
        residents_.pop_back();
        bytes_ -= tree_.chunks[chunk].bytes();
        table_.set(chunk, ChunkState::absent);
        drops_.push_back(chunk);
    }
    return memory_ - std::min(bytes_, memory_);
}

void Residency::add(std::uint32_t chunk) {
    residents_.push_back(chunk);
    bytes_ += tree_.chunks[chunk].bytes();
    peak_bytes_ = std::max(peak_bytes_, bytes_);
}

std::uint64_t Residency::own_bytes() const {
    return (residents_.capacity() + depth_.capacity()) * sizeof(std::uint32_t);
}

} // namespace abut
