#pragma once

#include <abut/broad_phase.h>

#include "world/broad_phase/pair_changes.h"
#include "world/narrow_phase/world_data.h"

#include <cstddef>
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
    /// The warm start of the k-th pair.
    [[nodiscard]] PairWarmStart& warm_start(std::size_t k) {
        return warm_starts_[places_[k].place];
    }

private:
    /// Where the warm start of a pair is. Pairs that begin have none yet.
    struct WarmStartPlace {
        static constexpr std::uint32_t kNone = ~std::uint32_t{0};
        std::uint32_t place = kNone;
    };
    void place_warm_starts();

    const WorldData& bodies_;
    BroadPhase broad_phase_;
    std::vector<Box3> boxes_; ///< grown by half of the margin
    std::vector<std::uint32_t> generations_;
    std::vector<std::uint32_t> changed_;
    std::vector<std::uint8_t> is_new_; ///< whether a body has another generation than before
    /// Warm starts stay where they are while their pairs stay: the sorted list of pairs moves in each step,
    /// and only the places move with it.
    std::vector<PairWarmStart> warm_starts_;
    std::vector<WarmStartPlace> places_; ///< of each pair
    /// Of each warm start: whether a pair has it, and whether one had it in the last step.
    std::vector<std::uint8_t> is_taken_, was_taken_;
    PairChanges changes_; ///< empty between updates
};

} // namespace abut
