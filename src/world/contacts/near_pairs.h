#pragma once

#include <abut/broad_phase.h>

#include "world/broad_phase/pair_changes.h"
#include "world/narrow_phase/world_data.h"

#include <cstdint>
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
    PairChanges changes_; ///< empty between updates
};

} // namespace abut
