#include "world/broad_phase/loose_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace abut {

namespace {

/// A loose box reaches as far ahead as its box moves in this many steps,
constexpr double kMostAhead = 64;
/// or in fewer, if boxes would move farther than this share of the mean side. All boxes look ahead
/// equally many steps, so that most leave their loose boxes in the same step.
constexpr double kAhead = 0.15;
/// A loose box is larger on each side by this share of the mean side, and by these steps. Without
/// the first, boxes that stand still and tremble would leave theirs.
constexpr double kMargin = 0.01, kMarginSteps = 1;
/// The share of the mean side as long as no motion is known.
constexpr double kFirstMargin = 0.05;

/// If more than one box in this many has left its loose box, all get new ones: that costs about as
/// much as moving so many boxes one after the other.
constexpr std::size_t kFewLeft = 16;
/// Giving all boxes new loose boxes costs about as much as two steps of the tree. It must not be
/// needed sooner than after this many steps.
constexpr std::size_t kLeastSteps = 4;
/// Pairs of loose boxes for each box beyond which a search that finds all pairs anew is faster.
constexpr std::size_t kMostPairs = 64;

} // namespace

LooseSearch::LooseSearch(PairFilter filter)
    : filter_(std::move(filter)), tree_(make_tree_search({})) {}

void LooseSearch::begin(std::span<const Box3> boxes) {
    boxes_.resize(boxes.size());
    loose_lines_.resize(boxes.size());
    loose_.resize(boxes.size());
    starts_.resize(boxes.size());
    all_.resize(boxes.size());
    std::iota(all_.begin(), all_.end(), 0);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        boxes_[i].set(boxes[i]);
    knows_motion_ = false;
    for (const std::uint32_t box : all_)
        loosen(box);
    tree_->restart(loose_, loose_pairs_);
    meets_.assign(loose_pairs_.size(), 0);
    flipped_.resize(loose_pairs_.size());
    find_flipped(boxes_, loose_pairs_.pairs(), meets_, flipped_);
    all_loosened_ = step_;
}

/// The change of each bound a step since the box got its loose box; 0 if it is not known.
LooseSearch::Motion LooseSearch::motion_of(std::uint32_t box) const {
    const BoxLine &now = boxes_[box], &from = starts_[box].box;
    const double steps = static_cast<double>(std::max<std::size_t>(step_ - starts_[box].step, 1));
    const auto each = [&](double before, double after) {
        const double change = (after - before) / steps;
        return knows_motion_ && std::isfinite(change) ? change : 0;
    };
    Motion motion;
    for (std::size_t k = 0; k < 3; ++k) {
        motion.side += (now.upper[k] - now.lower[k]) / 3;
        motion.lower[k] = each(from.lower[k], now.lower[k]);
        motion.upper[k] = each(from.upper[k], now.upper[k]);
        motion.speed =
            std::max({motion.speed, std::abs(motion.lower[k]), std::abs(motion.upper[k])});
    }
    if (!std::isfinite(motion.side))
        motion.side = 0;
    return motion;
}

void LooseSearch::loosen(std::uint32_t box) {
    const Motion motion = motion_of(box);
    // No box reaches ahead by more than a third of its side.
    const double ahead = motion.speed > 0 ? std::min(ahead_, motion.side / (3 * motion.speed)) : 0,
                 margin = knows_motion_ ? kMargin * motion.side +
                                              kMarginSteps * std::min(motion.speed, motion.side)
                                        : kFirstMargin * motion.side;
    const BoxLine& now = boxes_[box];
    BoxLine& loose = loose_lines_[box];
    loose = now;
    for (std::size_t k = 0; k < 3; ++k) {
        loose.lower[k] -= margin + std::max(-ahead * motion.lower[k], 0.0);
        loose.upper[k] += margin + std::max(ahead * motion.upper[k], 0.0);
    }
    loose_[box] = now.takes_any_part() ? Box3{{loose.lower[0], loose.lower[1], loose.lower[2]},
                                              {loose.upper[0], loose.upper[1], loose.upper[2]}}
                                       : Box3{{1, 1, 1}, {0, 0, 0}};
    starts_[box] = {now, step_};
}

/// Sets how far loose boxes look ahead. False if that is not worth their while.
bool LooseSearch::look_ahead() {
    if (knows_motion_ && step_ - all_loosened_ < kLeastSteps)
        return false;
    knows_motion_ = true;
    double sides = 0, speeds = 0;
    for (const std::uint32_t box : all_) {
        const Motion motion = motion_of(box);
        sides += motion.side, speeds += motion.speed;
    }
    ahead_ = speeds > 0 ? std::min(kMostAhead, kAhead * sides / speeds) : kMostAhead;
    return ahead_ >= static_cast<double>(kLeastSteps);
}

void LooseSearch::move_boxes(const BoxStep& step) {
    left_.resize(step.changed.size());
    std::size_t left = 0;
    for (const std::uint32_t box : step.changed) {
        const Box3& now = step.boxes[box];
        const BoxLine& loose = loose_lines_[box];
        boxes_[box].set(now);
        left_[left] = box;
        left += lies_in(now, loose) || !(takes_part(now) || loose.takes_any_part()) ? 0 : 1;
    }
    left_.resize(left);
}

bool LooseSearch::try_update(const BoxStep& step, PairList& list) {
    if (step.boxes.size() != boxes_.size() || loose_pairs_.size() > kMostPairs * boxes_.size())
        return false;
    ++step_;
    move_boxes(step);
    const bool is_all = left_.size() * kFewLeft > boxes_.size();
    if (is_all && !look_ahead())
        return false;
    begun_.clear(), ended_.clear();
    const std::vector<IndexPair>& pairs = loose_pairs_.pairs();
    const std::size_t flipped = find_flipped(boxes_, pairs, meets_, flipped_);
    for (const std::uint32_t place : std::span(flipped_).first(flipped))
        (meets_[place] != 0 ? begun_ : ended_).push_back(pairs[place]);
    if (is_all)
        loosen_all();
    else if (!left_.empty())
        loosen_some();
    if (filter_) {
        keep_wanted(begun_), keep_wanted(ended_);
        list.change(begun_, ended_);
    } else {
        report(list);
    }
    return true;
}

/// Sets the list to the pairs of loose boxes whose boxes meet, or leaves it to wait if few pairs
/// have changed.
void LooseSearch::report(PairList& list) {
    constexpr std::size_t kFewChanges = 64;
    const std::vector<IndexPair>& pairs = loose_pairs_.pairs();
    if ((begun_.size() + ended_.size()) * kFewChanges <= pairs.size()) {
        list.change(begun_, ended_);
        return;
    }
    now_.resize(pairs.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        now_[count] = pairs[i]; // always written: whether a pair meets cannot be predicted
        count += meets_[i];
    }
    now_.resize(count);
    list.replace(now_, begun_, ended_);
}

void LooseSearch::loosen_all() {
    for (const std::uint32_t box : all_)
        loosen(box);
    tree_->update({loose_, all_}, loose_pairs_);
    all_loosened_ = step_;
    add_new_pairs();
    meets_.assign(loose_pairs_.size(), 0);
    flipped_.resize(loose_pairs_.size());
    find_flipped(boxes_, loose_pairs_.pairs(), meets_, flipped_);
}

void LooseSearch::loosen_some() {
    for (const std::uint32_t box : left_)
        loosen(box);
    tree_->update({loose_, left_}, loose_pairs_);
    PairChanges changes;
    changes.add(loose_pairs_.begun(), loose_pairs_.ended());
    const std::vector<IndexPair>& pairs = loose_pairs_.pairs();
    // Pairs of loose boxes that ended are apart, and so were their boxes when they were tested.
    apply(changes.settle(), pairs, meets_);
    flipped_.resize(pairs.size());
    add_new_pairs();
    for (const IndexPair pair : begun_)
        meets_[static_cast<std::size_t>(std::lower_bound(pairs.begin(), pairs.end(), pair) -
                                        pairs.begin())] = 1;
}

void LooseSearch::add_new_pairs() {
    const auto before = static_cast<std::ptrdiff_t>(begun_.size());
    for (const IndexPair pair : loose_pairs_.begun()) {
        std::uint8_t meets = 0;
        std::uint32_t place = 0;
        if (find_flipped(boxes_, {&pair, 1}, {&meets, 1}, {&place, 1}) > 0)
            begun_.push_back(pair);
    }
    std::inplace_merge(begun_.begin(), begun_.begin() + before, begun_.end());
}

void LooseSearch::keep_wanted(std::vector<IndexPair>& pairs) const {
    const auto is_unwanted = [&](IndexPair pair) { return !filter_(pair.a(), pair.b()); };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_unwanted), pairs.end());
}

} // namespace abut
