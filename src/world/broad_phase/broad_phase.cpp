#include <abut/broad_phase.h>
#include <abut/error.h>

#include "world/broad_phase/box_strips.h"
#include "world/broad_phase/pair_list.h"
#include "world/broad_phase/pair_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

namespace abut {

namespace {

void require_numbers(const Box3& box, std::size_t index) {
    const double sum = box.lower.x * 0 + box.lower.y * 0 + box.lower.z * 0 + box.upper.x * 0 +
                       box.upper.y * 0 + box.upper.z * 0;
    if (sum == 0)
        return;
    for (const double bound :
         {box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z})
        if (std::isnan(bound))
            throw Error(ErrorCode::bad_argument,
                        "box " + std::to_string(index) + " has a bound that is not a number");
}

std::unique_ptr<PairSearch> make_search(BroadPhaseOptions options) {
    switch (options.method) {
    case BroadPhaseMethod::tree:
        return make_tree_search(std::move(options.filter));
    case BroadPhaseMethod::sweep:
        return make_sweep_search(std::move(options.filter));
    case BroadPhaseMethod::sweep_and_prune:
        return make_sweep_and_prune(std::move(options.filter));
    case BroadPhaseMethod::automatic:
        break;
    }
    return make_automatic_search(options.filter);
}

} // namespace

const char* to_string(BroadPhaseMethod method) {
    constexpr std::array kNames{"automatic", "tree", "sweep", "sweep_and_prune"};
    return kNames[static_cast<std::size_t>(method)];
}

BroadPhase::BroadPhase(BroadPhaseOptions options)
    : search_(make_search(std::move(options))), list_(std::make_unique<PairList>()) {}
BroadPhase::~BroadPhase() = default;
BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;

void BroadPhase::update(std::span<const Box3> boxes) {
    std::vector<std::uint32_t> all(boxes.size());
    std::iota(all.begin(), all.end(), 0);
    update(boxes, all);
}

void BroadPhase::update(std::span<const Box3> boxes, std::span<const std::uint32_t> changed) {
    for (const std::uint32_t i : changed)
        require_numbers(boxes[i], i);
    if (forgotten_ || boxes.size() < boxes_)
        search_->restart(boxes, *list_);
    else if (changed.empty() && boxes.size() == boxes_)
        list_->change({}, {});
    else
        search_->update({boxes, changed}, *list_);
    forgotten_ = false;
    boxes_ = boxes.size();
}

void BroadPhase::forget() {
    forgotten_ = true;
}

const std::vector<IndexPair>& BroadPhase::pairs() const noexcept {
    return list_->pairs();
}
const std::vector<IndexPair>& BroadPhase::begun() const noexcept {
    return list_->begun();
}
const std::vector<IndexPair>& BroadPhase::ended() const noexcept {
    return list_->ended();
}

std::vector<IndexPair>
overlapping_boxes(std::span<const Box3> boxes, double gap,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& filter) {
    if (!(gap >= 0) || std::isinf(gap))
        throw Error(ErrorCode::bad_argument, "gap of boxes must be a length, not negative");
    for (std::size_t i = 0; i < boxes.size(); ++i)
        require_numbers(boxes[i], i);
    return overlaps_by_strips(boxes, gap, filter);
}

} // namespace abut
