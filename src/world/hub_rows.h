#pragma once

#include <abut/broad_phase.h>

#include "world/box_block.h"
#include "world/pair_bits.h"
#include "world/pair_list.h"
#include "world/pair_search.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The pairs of hubs. Hubs are tested against all boxes in the order of their indices, sixteen at a
/// time: so their pairs need not be sorted, and what begins and ends is where bits differ.
class HubRows {
public:
    /// In          pairs: of the last step; those with a hub are taken over.
    void assign(HubSet hubs, std::span<const IndexPair> pairs);
    [[nodiscard]] const HubSet& hubs() const { return hubs_; }

    /// Brings the pairs to this step.
    /// Cost        a SIMD test for 16 pairs of a hub, where one of them or the hub has changed.
    void update(const BoxStep& step, const PairFilter& wanted);

    [[nodiscard]] const PairBits& pairs() const { return bits_.now; }
    /// By the last update.
    [[nodiscard]] const PairBits& begun() const { return bits_.begun; }
    [[nodiscard]] const PairBits& ended() const { return bits_.ended; }

private:
    static constexpr std::size_t kWidth = BoxBlock::kWidth;
    struct Side;
    class Comparison;

    void fit(const BoxStep& step);

    HubSet hubs_;
    struct {
        PairBits now, begun, ended;
    } bits_;
    NarrowFrame frame_;
    std::vector<BoxBlock> boxes_, hub_boxes_;    ///< in the order of their indices
    BoxMarks is_changed_, is_hub_block_changed_; ///< by block
    bool is_new_ = true;                         ///< boxes are yet to be fitted
};

} // namespace abut
