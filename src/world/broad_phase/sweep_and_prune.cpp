#include "world/broad_phase/sweep_and_prune.h"

#include "math/vector.h"
#include "world/broad_phase/box_node.h"

#include <algorithm>

namespace abut {

namespace {

void sort_and_unite(std::vector<IndexPair>& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

} // namespace

SweepAndPrune::End SweepAndPrune::end_of(const Box3& box, std::uint32_t name, int axis) {
    const bool is_upper = (name & 1) != 0;
    // An empty box has its upper end below all other ends and its lower end above them, those of
    // other empty boxes included. A box that becomes empty thus changes places with all that it
    // overlapped.
    constexpr double kBeyond = std::numeric_limits<double>::infinity(),
                     kMost = std::numeric_limits<double>::max();
    if (!takes_part(box))
        return {is_upper ? -kBeyond : kBeyond, name};
    return {std::clamp(component(is_upper ? box.upper : box.lower, axis), -kMost, kMost), name};
}

void SweepAndPrune::sort_axes(std::span<const Box3> boxes) {
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<End>& ends = ends_[axis];
        ends.resize(2 * boxes.size());
        for (std::uint32_t name = 0; name < ends.size(); ++name)
            ends[name] = end_of(boxes[name / 2], name, axis);
        std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.before(b); });
    }
    last_.assign(boxes.begin(), boxes.end());
}

void SweepAndPrune::restart(std::span<const Box3> boxes, PairList& list) {
    sort_axes(boxes);
    bulk_->restart(boxes, list);
}

void SweepAndPrune::update(const BoxStep& step, PairList& list) {
    // If more ends change places, sorting anew and comparing on one axis is faster.
    constexpr std::size_t kMovesOfBox = 64;
    if (!try_update(step, list, kMovesOfBox * step.boxes.size()))
        restart(step.boxes, list);
}

bool SweepAndPrune::try_update(const BoxStep& step, PairList& list, std::size_t most) {
    if (step.boxes.size() != last_.size())
        return false;
    begun_.clear(), ended_.clear();
    for (int axis = 0; axis < 3; ++axis)
        if (!sort_axis(step.boxes, axis, most))
            return false;
    for (const std::uint32_t box : step.changed)
        last_[box] = step.boxes[box];
    sort_and_unite(begun_);
    sort_and_unite(ended_);
    if (filter_) {
        const auto unwanted = [&](IndexPair pair) { return !filter_(pair.a(), pair.b()); };
        begun_.erase(std::remove_if(begun_.begin(), begun_.end(), unwanted), begun_.end());
        ended_.erase(std::remove_if(ended_.begin(), ended_.end(), unwanted), ended_.end());
    }
    list.change(begun_, ended_);
    return true;
}

bool SweepAndPrune::sort_axis(std::span<const Box3> boxes, int axis, std::size_t& moves_left) {
    std::vector<End>& ends = ends_[axis];
    for (End& end : ends)
        end = end_of(boxes[end.box()], end.name, axis);
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const End end = ends[i];
        std::size_t k = i;
        for (; k > 0 && end.before(ends[k - 1]); --k) {
            if (end.is_upper() != ends[k - 1].is_upper() && end.box() != ends[k - 1].box())
                compare(boxes, end.box(), ends[k - 1].box());
            ends[k] = ends[k - 1];
        }
        ends[k] = end;
        if (i - k > moves_left)
            return false;
        moves_left -= i - k;
    }
    return true;
}

void SweepAndPrune::compare(std::span<const Box3> boxes, std::uint32_t i, std::uint32_t k) {
    const bool before = have_common_point(last_[i], last_[k]),
               now = have_common_point(boxes[i], boxes[k]);
    if (before != now)
        (now ? begun_ : ended_).emplace_back(i, k);
}

std::unique_ptr<PairSearch> make_sweep_and_prune(PairFilter filter) {
    return std::make_unique<SweepAndPrune>(std::move(filter));
}

} // namespace abut
