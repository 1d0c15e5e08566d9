#include "world/hub_rows.h"

#include "core/parallel.h"

#include <algorithm>
#include <array>
#include <bit>

namespace abut {

namespace {

using Bits = std::uint32_t;

/// Calls visit(lane) for each bit.
template <typename Visit>
void for_each_lane(Bits bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1)
        visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

/// Boxes of one block, by sorted indices.
struct Side {
    const BoxBlock& block;
    Aabb bounds;
    std::span<const std::uint32_t> boxes;

    /// Lanes of boxes with a higher index.
    [[nodiscard]] Bits above(std::uint32_t box) const {
        if (box < boxes.front())
            return BoxBlock::kAllLanes;
        const auto first = std::upper_bound(boxes.begin(), boxes.end(), box) - boxes.begin();
        return BoxBlock::kAllLanes & (BoxBlock::kAllLanes << first);
    }
};

} // namespace

/// What one task finds.
class HubRows::Comparison {
public:
    Comparison(std::span<const Box3> boxes, const PairFilter& wanted, std::vector<IndexPair>& begun,
               std::vector<IndexPair>& ended)
        : boxes_(boxes), wanted_(wanted), begun_(begun), ended_(ended) {}

    /// Some boxes of a side against those of another with a higher index. In/out: the first box's
    /// bits, and how far the next ones' are.
    void compare(const Side& a, Bits rows, const Side& b, std::uint16_t* bits,
                 std::size_t stride) const {
        BlockMeetings meetings;
        find_meetings(a.block, rows, b.block, b.bounds, meetings);
        for_each_lane(rows, [&](std::uint32_t row) {
            const bool any = (meetings.rows >> row & 1) != 0;
            const Bits meet = any ? meetings.meet[row] & b.above(a.boxes[row]) : 0;
            const Bits unclear = meet != 0 ? meet & meetings.touch[row] : 0;
            replace(bits[row * stride], meet, unclear, a.boxes[row], b.boxes);
        });
    }

private:
    void replace(std::uint16_t& bits, Bits meet, Bits unclear, std::uint32_t box,
                 std::span<const std::uint32_t> partners) const {
        for_each_lane(unclear, [&](std::uint32_t lane) {
            if (!abut::meet(boxes_[box], boxes_[partners[lane]]))
                meet &= ~(Bits{1} << lane);
        });
        if (wanted_)
            for_each_lane(meet & ~Bits{bits}, [&](std::uint32_t lane) {
                if (!wanted_(box, partners[lane]))
                    meet &= ~(Bits{1} << lane);
            });
        for_each_lane(meet & ~Bits{bits},
                      [&](std::uint32_t lane) { begun_.emplace_back(box, partners[lane]); });
        for_each_lane(bits & ~meet,
                      [&](std::uint32_t lane) { ended_.emplace_back(box, partners[lane]); });
        bits = static_cast<std::uint16_t>(meet);
    }

    std::span<const Box3> boxes_;
    const PairFilter& wanted_;
    std::vector<IndexPair>&begun_, &ended_;
};

void HubRows::assign(std::vector<std::uint32_t> hubs, std::size_t boxes,
                     std::span<const IndexPair> pairs) {
    hubs_ = std::move(hubs);
    is_hub_.assign(boxes, 0);
    for (const std::uint32_t hub : hubs_)
        is_hub_[hub] = 1;
    of_hubs_.resize(hubs_.size(), boxes);
    of_boxes_.resize(boxes, hubs_.size());
    pairs_of_task_.assign((boxes + kBoxesOfTask - 1) / kBoxesOfTask, 0);
    for (const IndexPair pair : pairs) {
        if (!has(pair))
            continue;
        ++pairs_of_task_[pair.a() / kBoxesOfTask];
        if (is_hub_[pair.a()] != 0)
            of_hubs_.set(rank_of(pair.a()), pair.b());
        else
            of_boxes_.set(pair.a(), rank_of(pair.b()));
    }
    is_new_ = true;
}

std::size_t HubRows::rank_of(std::uint32_t hub) const {
    return static_cast<std::size_t>(std::lower_bound(hubs_.begin(), hubs_.end(), hub) -
                                    hubs_.begin());
}

/// Puts the boxes that have changed into their blocks, and marks these.
void HubRows::fit(const BoxStep& step) {
    const bool all = is_new_ || step.all_changed();
    boxes_.resize(of_hubs_.columns), hub_boxes_.resize(of_boxes_.columns);
    is_changed_.assign(boxes_.size(), all ? 1 : 0);
    is_hub_block_changed_.assign(hub_boxes_.size(), all ? 1 : 0);
    if (all)
        frame_ = NarrowFrame::about(step.boxes);
    else
        for (const std::uint32_t box : step.changed) {
            is_changed_[box / kWidth] = 1;
            if (is_hub_[box] != 0)
                is_hub_block_changed_[rank_of(box) / kWidth] = 1;
        }
    is_new_ = false;
    const auto fit_blocks = [&](std::vector<BoxBlock>& blocks, const BoxMarks& changed,
                                std::size_t count, const auto& box_at) {
        parallel_for(blocks.size(), 64, [&](std::size_t block) {
            if (changed[block] == 0)
                return;
            for (std::size_t lane = 0; lane < kWidth; ++lane) {
                const std::size_t at = block * kWidth + lane;
                blocks[block].set(lane,
                                  at < count ? frame_.narrow(step.boxes[box_at(at)]) : Aabb());
            }
        });
    };
    fit_blocks(boxes_, is_changed_, is_hub_.size(), [](std::size_t at) { return at; });
    fit_blocks(hub_boxes_, is_hub_block_changed_, hubs_.size(),
               [&](std::size_t at) { return hubs_[at]; });
}

void HubRows::update(const BoxStep& step, const PairFilter& wanted,
                     std::vector<std::vector<IndexPair>>& begun,
                     std::vector<std::vector<IndexPair>>& ended) {
    fit(step);
    std::vector<Side> hub_sides;
    for (std::size_t block = 0; block < hub_boxes_.size(); ++block)
        hub_sides.push_back({hub_boxes_[block], hub_boxes_[block].bounds(),
                             std::span<const std::uint32_t>(hubs_).subspan(
                                 block * kWidth, std::min(kWidth, hubs_.size() - block * kWidth))});
    constexpr std::size_t kBlocksOfTask = 16;
    const std::size_t tasks = (boxes_.size() + kBlocksOfTask - 1) / kBlocksOfTask;
    begun.resize(tasks), ended.resize(tasks);
    parallel_for(tasks, 1, [&](std::size_t task) {
        begun[task].clear(), ended[task].clear();
        const Comparison comparison(step.boxes, wanted, begun[task], ended[task]);
        const std::size_t end = std::min(boxes_.size(), (task + 1) * kBlocksOfTask);
        for (std::size_t block = task * kBlocksOfTask; block < end; ++block) {
            std::array<std::uint32_t, kWidth> boxes{};
            const std::size_t first = block * kWidth, count = std::min(kWidth, size() - first);
            Bits others = 0;
            for (std::size_t lane = 0; lane < count; ++lane) {
                boxes[lane] = static_cast<std::uint32_t>(first + lane);
                others |= is_hub_[first + lane] == 0 ? Bits{1} << lane : 0;
            }
            const Side side{boxes_[block], boxes_[block].bounds(), std::span(boxes).first(count)};
            for (std::size_t hubs = 0; hubs < hub_sides.size(); ++hubs) {
                if ((is_changed_[block] | is_hub_block_changed_[hubs]) == 0)
                    continue;
                const Side& hub_side = hub_sides[hubs];
                if (side.boxes.front() < hub_side.boxes.back())
                    comparison.compare(side, others, hub_side,
                                       &of_boxes_.bits[first * of_boxes_.columns + hubs],
                                       of_boxes_.columns);
                if (hub_side.boxes.front() < side.boxes.back())
                    comparison.compare(hub_side, (Bits{1} << hub_side.boxes.size()) - 1, side,
                                       &of_hubs_.bits[hubs * kWidth * of_hubs_.columns + block],
                                       of_hubs_.columns);
            }
        }
    });
    for (std::size_t task = 0; task < tasks; ++task) {
        for (const IndexPair pair : begun[task])
            ++pairs_of_task_[pair.a() / kBoxesOfTask];
        for (const IndexPair pair : ended[task])
            --pairs_of_task_[pair.a() / kBoxesOfTask];
    }
}

IndexPair* HubRows::write_row(std::uint32_t box, IndexPair* to) const {
    const auto write_bits = [&](Bits bits, const auto& partner) {
        const auto pair = [&](std::uint32_t lane) {
            return IndexPair::of_key(std::uint64_t{box} << 32 | partner(lane));
        };
        if (bits == BoxBlock::kAllLanes) {
            for (std::uint32_t lane = 0; lane < kWidth; ++lane)
                to[lane] = pair(lane);
            to += kWidth;
            return;
        }
        // Without a branch on the data: what is no pair is written over. The last one is a pair.
        for (std::uint32_t lane = 0; bits != 0; ++lane, bits >>= 1) {
            *to = pair(lane);
            to += bits & 1;
        }
    };
    if (is_hub_[box] != 0) {
        const std::span<const std::uint16_t> row = of_hubs_.row(rank_of(box));
        for (std::size_t column = box / kWidth; column < row.size(); ++column) {
            const auto first = static_cast<std::uint32_t>(column * kWidth);
            write_bits(row[column], [&](std::uint32_t lane) { return first + lane; });
        }
    } else {
        const std::span<const std::uint16_t> row = of_boxes_.row(box);
        for (std::size_t column = 0; column < row.size(); ++column) {
            const std::uint32_t* const hubs = &hubs_[column * kWidth];
            write_bits(row[column], [&](std::uint32_t lane) { return hubs[lane]; });
        }
    }
    return to;
}

/// Puts what lies from `others` to `end` between the pairs from `from` to `from_end`, all sorted; there
/// is room for it in front of them, from `to` on.
void put_between(const IndexPair* others, const IndexPair* end, IndexPair* from,
                 IndexPair* from_end, IndexPair* to) {
    for (; others != end; ++others) {
        // Without a branch on the data, other than std::lower_bound.
        IndexPair* next = from;
        for (std::ptrdiff_t left = from_end - from; left > 0;) {
            const std::ptrdiff_t half = (left + 1) / 2;
            next += half * static_cast<std::ptrdiff_t>(next[half - 1] < *others);
            left -= half;
        }
        to = std::copy(from, next, to);
        *to++ = *others;
        from = next;
    }
}

void HubRows::write(std::span<const IndexPair> others, std::vector<IndexPair>& pairs) const {
    const std::size_t tasks = pairs_of_task_.size();
    const auto first_box = [&](std::size_t task) {
        return static_cast<std::uint32_t>(std::min(task * kBoxesOfTask, size()));
    };
    const auto first_other = [&](std::size_t task) {
        const std::uint32_t box = first_box(task);
        const auto at = std::lower_bound(others.begin(), others.end(), IndexPair(box, box));
        return others.data() + (at - others.begin());
    };
    std::vector<std::size_t> first{0};
    for (std::size_t task = 0; task < tasks; ++task)
        first.push_back(first.back() + pairs_of_task_[task] +
                        static_cast<std::size_t>(first_other(task + 1) - first_other(task)));
    pairs.resize(first[tasks]);
    parallel_for(tasks, 1, [&](std::size_t task) {
        IndexPair* to = pairs.data() + first[task];
        const IndexPair *other = first_other(task), *const others_end = first_other(task + 1);
        for (std::uint32_t box = first_box(task); box < first_box(task + 1); ++box) {
            const IndexPair* end = other;
            while (end != others_end && end->a() == box)
                ++end;
            IndexPair* const from = to + (end - other);
            IndexPair* const row_end = write_row(box, from);
            put_between(other, end, from, row_end, to);
            other = end, to = row_end;
        }
    });
}

} // namespace abut
