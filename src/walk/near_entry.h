#pragma once

#include <abut/walk.h>

#include "core/stop.h"
#include "walk/walk_data.h"
#include "world/narrow_phase/narrow_phase.h"

#include <cstdint>

namespace abut {

/// A part in memory, or a mesh block of one.
struct NearEntry {
    WalkPart part;
    const BodyShape& shape;
    const Transform& world;
    const LoadedChunk* chunk = nullptr; ///< null for a part that was added

    [[nodiscard]] PlacedBody body() const { return {shape, world}; }
    [[nodiscard]] const Model& model() const { return std::get<Model>(shape); }
    /// The number in the whole mesh of a triangle of the shape.
    [[nodiscard]] std::uint32_t triangle(std::uint32_t own) const {
        const bool is_cut = chunk != nullptr && own < chunk->triangle_ids.size();
        return is_cut ? chunk->triangle_ids[own] : own;
    }
};

/// Brings the entries that a query reaches into its hands: those that are not in memory are read
/// or skipped, as the query asks, and counted in its answer.
class EntryVisit {
public:
    /// In          asks_for_solids: whether models of parts are used as solids.
    EntryVisit(WalkData& walk, const WalkQuery& query, bool asks_for_solids, WalkAnswer& answer)
        : walk_(walk), query_(query), asks_for_solids_(asks_for_solids), answer_(answer) {}

    /// Calls visit(near entry), or skip() if it is not in memory. Returns what visit returned, else
    /// `otherwise`.
    template <typename Visit, typename Skip>
    double operator()(std::uint32_t entry, double otherwise, const Visit& visit,
                      const Skip& skip) const {
        poll_stop();
        const WalkPart part = walk_.part_of(entry);
        if (part == query_.except)
            return otherwise;
        ++answer_.candidates;
        if (walk_.is_added(entry)) {
            const AddedPart& added = walk_.added(entry);
            return visit(NearEntry{part, added.shape, added.world_from_part});
        }
        const std::uint64_t misses = walk_.misses();
        const PartCache::Pin pin = walk_.lookup(entry, query_.missing);
        answer_.misses += walk_.misses() - misses;
        if (!pin) {
            skip();
            return otherwise;
        }
        if (asks_for_solids_ && !pin->chunk->is_block)
            walk_.cache().count_solid(pin);
        return visit(NearEntry{part, pin->chunk->shape, pin->world_from_mesh, pin->chunk.get()});
    }

private:
    WalkData& walk_;
    const WalkQuery& query_;
    bool asks_for_solids_;
    WalkAnswer& answer_;
};

} // namespace abut
