#pragma once

#include <abut/broad_phase.h>

#include "world/broad_phase/pair_changes.h"
#include "world/narrow_phase/world_data.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace abut {

/// The pairs of bodies whose boxes are at most a margin apart, and a warm start for each, from step
/// to step. Refers to the bodies, which must outlive it.
class NearPairs {
public:
    explicit NearPairs(const WorldData& bodies);
    NearPairs(const NearPairs&) = delete;
    NearPairs& operator=(const NearPairs&) = delete;

    /// Finds the pairs. Some may be a few roundings farther apart than the margin.
    void update(double margin);
    /// Tells that options or filter of the bodies have changed.
    void forget() { broad_phase_.forget(); }

    /// Sets the latest placement that a query of contacts has seen. Returns that of the query before.
    std::uint64_t exchange_last_placement(std::uint64_t placement) {
        return std::exchange(last_placement_, placement);
    }
    [[nodiscard]] const std::vector<IndexPair>& pairs() const { return broad_phase_.pairs(); }
    [[nodiscard]] std::vector<PairWarmStart>& warm_starts() { return warm_starts_; }

private:
    const WorldData& bodies_;
    BroadPhase broad_phase_;
    std::vector<Box3> boxes_; ///< grown by half of the margin
    std::vector<std::uint32_t> generations_;
    std::vector<std::uint32_t> changed_;
    std::vector<std::uint8_t> is_new_; ///< whether a body has another generation than before
    std::vector<PairWarmStart> warm_starts_;
    std::uint64_t last_placement_ = 0;
    PairChanges changes_; ///< empty between updates
};

} // namespace abut
