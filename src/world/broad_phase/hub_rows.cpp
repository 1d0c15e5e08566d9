#include "world/broad_phase/hub_rows.h"

#include "core/parallel.h"
#include "core/set_bits.h"

#include <algorithm>
#include <array>
#include <utility>

namespace abut {

namespace {

using Bits = std::uint32_t;

constexpr Bits first_lanes(std::size_t count) {
    return (Bits{1} << count) - 1;
}

} // namespace

/// The boxes of one node, in ascending order of their indices.
struct HubRows::Side {
    const BoxNode& node;
    Aabb bounds;
    std::array<std::uint32_t, kWidth> boxes{};
    std::size_t count;
    Bits rows = 0; ///< boxes that are compared with others

    /// In          box_at(lane) returns the index of a lane's box.
    template <typename BoxAt>
    Side(const BoxNode& fitted, std::size_t boxes_in_node, const BoxAt& box_at)
        : node(fitted), bounds(fitted.bounds()), count(boxes_in_node) {
        for (std::size_t lane = 0; lane < count; ++lane)
            boxes[lane] = static_cast<std::uint32_t>(box_at(lane));
    }
    [[nodiscard]] std::uint32_t lowest() const { return boxes.front(); }
    [[nodiscard]] std::uint32_t highest() const { return boxes[count - 1]; }
    /// Lanes of the boxes with an index above `box`.
    [[nodiscard]] Bits above(std::uint32_t box) const {
        if (box < lowest())
            return first_lanes(count);
        const auto end = boxes.begin() + static_cast<std::ptrdiff_t>(count);
        return first_lanes(count) & ~first_lanes(static_cast<std::size_t>(
                                        std::upper_bound(boxes.begin(), end, box) - boxes.begin()));
    }
};

class HubRows::Comparison {
public:
    Comparison(std::span<const Box3> boxes, const PairFilter& filter, BitTable& now,
               BitTable& begun, BitTable& ended)
        : boxes_(boxes), filter_(filter), now_(now), begun_(begun), ended_(ended) {}

    /// Compares the boxes of a with those boxes of b that have a higher index. In: the row of a's
    /// first box, and the column of b's boxes.
    void compare(const Side& a, std::size_t row, const Side& b, std::size_t column) const {
        if (a.lowest() >= b.highest())
            return;
        BoxNodeMeetings meetings;
        find_meetings(a.node, a.rows, b.node, b.bounds, meetings);
        for (const std::uint32_t lane : SetBits(a.rows)) {
            const bool any = (meetings.rows >> lane & 1) != 0;
            const Bits meet = any ? meetings.meet[lane] & b.above(a.boxes[lane]) : 0;
            const Bits unclear = meet != 0 ? meet & meetings.touch[lane] : 0;
            replace((row + lane) * now_.columns + column, meet, unclear, a.boxes[lane], b.boxes);
        }
    }

private:
    void replace(std::size_t at, Bits meet, Bits unclear, std::uint32_t box,
                 std::span<const std::uint32_t> partners) const {
        for (const std::uint32_t lane : SetBits(unclear))
            if (!abut::meet(boxes_[box], boxes_[partners[lane]]))
                meet &= ~(Bits{1} << lane);
        const Bits last = now_.bits[at];
        if (filter_)
            for (const std::uint32_t lane : SetBits(meet & ~last))
                if (!filter_(box, partners[lane]))
                    meet &= ~(Bits{1} << lane);
        if (meet == last) // the bits in begun_ and ended_ are already zero
            return;
        now_.bits[at] = static_cast<std::uint16_t>(meet);
        begun_.bits[at] = static_cast<std::uint16_t>(meet & ~last);
        ended_.bits[at] = static_cast<std::uint16_t>(last & ~meet);
    }

    std::span<const Box3> boxes_;
    const PairFilter& filter_;
    BitTable &now_, &begun_, &ended_;
};

void HubRows::assign(HubSet hubs, std::span<const IndexPair> pairs) {
    hubs_ = std::move(hubs);
    bits_.now.assign(hubs_);
    for (const IndexPair pair : pairs)
        if (hubs_.has(pair))
            bits_.now.insert(hubs_, pair);
    bits_.now.count(hubs_);
    is_new_ = true;
}

/// Stores the changed boxes in their nodes, and marks these nodes.
void HubRows::fit(const BoxStep& step) {
    const std::vector<std::uint32_t>& hubs = hubs_.hubs();
    const auto blocks_of = [](std::size_t boxes) { return (boxes + kWidth - 1) / kWidth; };
    const bool all = is_new_ || step.all_changed();
    boxes_.resize(blocks_of(hubs_.boxes())), hub_boxes_.resize(blocks_of(hubs.size()));
    is_changed_.assign(boxes_.size(), all ? 1 : 0);
    is_hub_node_changed_.assign(hub_boxes_.size(), all ? 1 : 0);
    if (all)
        frame_ = NarrowFrame::about(step.boxes);
    else
        for (const std::uint32_t box : step.changed) {
            is_changed_[box / kWidth] = 1;
            if (hubs_.contains(box))
                is_hub_node_changed_[hubs_.rank_of(box) / kWidth] = 1;
        }
    is_new_ = false;
    const auto fit_nodes = [&](std::vector<BoxNode>& nodes, const BoxMarks& changed,
                               std::size_t count, const auto& box_at) {
        parallel_for(nodes.size(), 64, [&](std::size_t node) {
            if (changed[node] == 0)
                return;
            for (std::size_t lane = 0; lane < kWidth; ++lane) {
                const std::size_t at = node * kWidth + lane;
                nodes[node].set(lane, at < count ? frame_.narrow(step.boxes[box_at(at)]) : Aabb());
            }
        });
    };
    fit_nodes(boxes_, is_changed_, hubs_.boxes(), [](std::size_t at) { return at; });
    fit_nodes(hub_boxes_, is_hub_node_changed_, hubs.size(),
              [&](std::size_t at) { return hubs[at]; });
}

void HubRows::update(const BoxStep& step, const PairFilter& filter) {
    fit(step);
    bits_.begun.assign(hubs_), bits_.ended.assign(hubs_);
    std::vector<Side> hub_sides;
    for (std::size_t node = 0; node < hub_boxes_.size(); ++node) {
        const std::span rest = std::span(hubs_.hubs()).subspan(node * kWidth);
        hub_sides.emplace_back(hub_boxes_[node], std::min(kWidth, rest.size()),
                               [&](std::size_t lane) { return rest[lane]; });
        hub_sides.back().rows = first_lanes(hub_sides.back().count);
    }
    const Comparison with_hubs(step.boxes, filter, bits_.now.of_boxes, bits_.begun.of_boxes,
                               bits_.ended.of_boxes),
        of_hubs(step.boxes, filter, bits_.now.of_hubs, bits_.begun.of_hubs, bits_.ended.of_hubs);
    parallel_for(boxes_.size(), 16, [&](std::size_t node) {
        const std::size_t first = node * kWidth;
        Side boxes(boxes_[node], std::min(kWidth, hubs_.boxes() - first),
                   [&](std::size_t lane) { return first + lane; });
        for (std::size_t lane = 0; lane < boxes.count; ++lane)
            boxes.rows |= hubs_.contains(first + lane) ? 0 : Bits{1} << lane;
        for (std::size_t k = 0; k < hub_sides.size(); ++k)
            if ((is_changed_[node] | is_hub_node_changed_[k]) != 0) {
                with_hubs.compare(boxes, first, hub_sides[k], k);
                of_hubs.compare(hub_sides[k], k * kWidth, boxes, node);
            }
    });
    bits_.begun.count(hubs_), bits_.ended.count(hubs_);
    for (std::size_t part = 0; part < bits_.now.pairs_of_part.size(); ++part)
        bits_.now.pairs_of_part[part] +=
            bits_.begun.pairs_of_part[part] - bits_.ended.pairs_of_part[part];
}

} // namespace abut
