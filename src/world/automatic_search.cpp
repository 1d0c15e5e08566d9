#include "world/pair_search.h"
#include "world/sweep_and_prune.h"

#include <algorithm>

namespace abut {

namespace {

/// The tree, with hubs apart, which is good at everything; for small worlds in slow motion three sorted
/// axes, for which next to nothing changes.
///
/// How much changes places is known once the axes are sorted. So they are tried, with a limit at
/// which the try is given up; each time it fails, more steps pass before the next one.
class AutomaticSearch final : public PairSearch {
public:
    explicit AutomaticSearch(const PairFilter& wanted)
        : tree_(make_hub_search(make_tree_search(wanted), wanted)), axes_(wanted) {}

    void restart(std::span<const Box3> boxes, PairList& list) override {
        stay_with_tree();
        tree_->restart(boxes, list);
        tree_is_current_ = true;
    }

    void update(const BoxStep& step, PairList& list) override {
        const std::size_t boxes = step.boxes.size(), pairs = list.pairs().size();
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
    // Where both take about as long. The tree finds every pair anew in each step, which takes as long as
    // an end that changes places: of pairs beyond what boxes commonly have, half are counted.
    static constexpr std::size_t kMostBoxes = 4096;
    static constexpr std::size_t kMovesOfBox = 2;
    static constexpr std::size_t kManyPairs = 8;
    static constexpr std::size_t kShortestPause = 4, kLongestPause = 64;

    static std::size_t most_moves(std::size_t boxes, std::size_t pairs) {
        return kMovesOfBox * boxes + (pairs - std::min(pairs, kManyPairs * boxes)) / 2;
    }

    void stay_with_tree() {
        on_axes_ = false;
        pause_ = std::min(2 * pause_, kLongestPause);
        left_ = pause_;
    }

    std::unique_ptr<PairSearch> tree_;
    SweepAndPrune axes_;
    bool on_axes_ = false;
    bool tree_is_current_ = true;        ///< as of the last step
    std::size_t pause_ = kShortestPause; ///< steps with the tree after a try has failed
    std::size_t left_ = kShortestPause;  ///< of these
};

} // namespace

std::unique_ptr<PairSearch> make_automatic_search(const PairFilter& wanted) {
    return std::make_unique<AutomaticSearch>(wanted);
}

} // namespace abut
