#include "world/broad_phase/pair_search.h"
#include "world/broad_phase/sweep_and_prune.h"

#include <algorithm>

namespace abut {

namespace {

/// Uses the tree search with hubs, which is good in all cases. For small worlds in slow motion it
/// uses three sorted axes, on which almost nothing changes.
///
/// How many ends change places is known only once the axes are sorted. A try therefore has a limit
/// at which it is given up. Each failed try doubles the number of steps before the next one.
class AutomaticSearch final : public PairSearch {
public:
    explicit AutomaticSearch(const PairFilter& filter)
        : tree_(make_hub_search(make_tree_search(filter), filter)), axes_(filter) {}

    void restart(std::span<const Box3> boxes, PairList& list) override {
        stay_with_tree();
        tree_->restart(boxes, list);
        tree_is_current_ = true;
    }

    void update(const BoxStep& step, PairList& list) override {
        if (step.few_changed()) {
            update_few(step, list);
            return;
        }
        const std::size_t boxes = step.boxes.size(), pairs = list.size();
        if (on_axes_ && axes_.try_update(step, list, most_moves(boxes, pairs))) {
            pause_ = kShortestPause;
            tree_is_current_ = false;
            return;
        }
        if (!tree_is_current_) {
            restart(step.boxes, list);
            return;
        }
        if (on_axes_)
            stay_with_tree();
        tree_->update(step, list);
        if (boxes <= kMostBoxes && --left_ == 0) {
            axes_.sort_axes(step.boxes);
            on_axes_ = true;
        }
    }

private:
    // Limits at which both methods take about the same time. The tree finds every pair anew in each
    // step, which costs about as much as one change of places. Half of the pairs beyond the usual
    // number for each box are counted.
    static constexpr std::size_t kMostBoxes = 4096;
    static constexpr std::size_t kMovesOfBox = 2;
    static constexpr std::size_t kManyPairs = 8;
    static constexpr std::size_t kShortestPause = 4, kLongestPause = 64;

    static std::size_t most_moves(std::size_t boxes, std::size_t pairs) {
        return kMovesOfBox * boxes + (pairs - std::min(pairs, kManyPairs * boxes)) / 2;
    }

    /// The axes look at all ends; the tree looks only at the boxes that have changed.
    void update_few(const BoxStep& step, PairList& list) {
        if (on_axes_)
            left_ = pause_; // so that steps that change by turns do not sort the axes each time
        on_axes_ = false;
        left_ = std::max<std::size_t>(left_, 1);
        if (tree_is_current_)
            tree_->update(step, list);
        else
            tree_->restart(step.boxes, list);
        tree_is_current_ = true;
    }

    void stay_with_tree() {
        on_axes_ = false;
        pause_ = std::min(2 * pause_, kLongestPause);
        left_ = pause_;
    }

    std::unique_ptr<PairSearch> tree_;
    SweepAndPrune axes_;
    bool on_axes_ = false;
    bool tree_is_current_ = true;        ///< up to date with the last step
    std::size_t pause_ = kShortestPause; ///< steps with the tree after a failed try
    std::size_t left_ = kShortestPause;  ///< steps left until the next try
};

} // namespace

std::unique_ptr<PairSearch> make_automatic_search(const PairFilter& filter) {
    return std::make_unique<AutomaticSearch>(filter);
}

} // namespace abut
