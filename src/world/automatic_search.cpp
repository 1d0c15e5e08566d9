#include "world/pair_search.h"
#include "world/sweep_and_prune.h"

#include <algorithm>

namespace abut {

namespace {

/// The tree, which is good at everything; for small worlds in slow motion, three sorted axes, for
/// which next to nothing changes.
///
/// How much changes places is known once the axes are sorted. So they are tried, with a limit at
/// which the try is given up; each time it fails, more steps pass before the next one.
class AutomaticSearch final : public PairSearch {
public:
    explicit AutomaticSearch(const PairFilter& wanted)
        : tree_(make_tree_search(wanted)), axes_(wanted) {}

    void restart(std::span<const Box3> boxes, PairList& list) override {
        stay_with_tree();
        tree_->restart(boxes, list);
    }

    void update(const BoxStep& step, PairList& list) override {
        if (on_axes_ && axes_.try_update(step, list, kMovesOfBox * step.boxes.size())) {
            pause_ = 1;
            return;
        }
        if (on_axes_) {
            stay_with_tree();
            tree_->restart(step.boxes, list);
            return;
        }
        tree_->update(step, list);
        if (step.boxes.size() <= kMostBoxes && --left_ == 0) {
            axes_.sort_axes(step.boxes);
            on_axes_ = true;
        }
    }

private:
    // Where both take about as long.
    static constexpr std::size_t kMostBoxes = 4096;
    static constexpr std::size_t kMovesOfBox = 2;
    static constexpr std::size_t kLongestPause = 64;

    void stay_with_tree() {
        on_axes_ = false;
        pause_ = std::min(2 * pause_, kLongestPause);
        left_ = pause_;
    }

    std::unique_ptr<PairSearch> tree_;
    SweepAndPrune axes_;
    bool on_axes_ = false;
    std::size_t pause_ = 1; ///< steps with the tree after a try has failed
    std::size_t left_ = 1;  ///< of these
};

} // namespace

std::unique_ptr<PairSearch> make_automatic_search(const PairFilter& wanted) {
    return std::make_unique<AutomaticSearch>(wanted);
}

} // namespace abut
