#pragma once

#include <abut/broad_phase.h>

#include "world/broad_phase/box_node.h"
#include "world/broad_phase/pair_bits.h"
#include "world/broad_phase/pair_list.h"
#include "world/broad_phase/pair_search.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The pairs that contain a hub. Hubs are tested against all boxes, sixteen at a time, in the order
/// of the boxes' indices. Their pairs therefore need no sorting, and differing bits tell which
/// pairs begin and end.
class HubRows {
public:
    /// In          pairs: the pairs of the last step; those with a hub are stored.
    void assign(HubSet hubs, std::span<const IndexPair> pairs);
    [[nodiscard]] const HubSet& hubs() const { return hubs_; }

    /// Updates the pairs to this step.
    /// Cost        a SIMD test for each 16 pairs of a hub, if one of the boxes or the hub has
    ///             changed.
    void update(const BoxStep& step, const PairFilter& filter);

    [[nodiscard]] const PairBits& pairs() const { return bits_.now; }
    /// Pairs that began or ended with the last update.
    [[nodiscard]] const PairBits& begun() const { return bits_.begun; }
    [[nodiscard]] const PairBits& ended() const { return bits_.ended; }

private:
    static constexpr std::size_t kWidth = BoxNode::kWidth;
    struct Side;
    class Comparison;

    void fit(const BoxStep& step);

    HubSet hubs_;
    struct {
        PairBits now, begun, ended;
    } bits_;
    NarrowFrame frame_;
    std::vector<BoxNode> boxes_, hub_boxes_;    ///< in the order of their indices
    BoxMarks is_changed_, is_hub_node_changed_; ///< by node
    bool is_new_ = true;                        ///< the boxes have not been fitted yet
};

} // namespace abut
