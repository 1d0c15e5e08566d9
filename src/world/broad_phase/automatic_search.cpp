#include "world/broad_phase/loose_search.h"
#include "world/broad_phase/pair_search.h"

#include <algorithm>

namespace abut {

namespace {

/// Uses the tree search with hubs, which is good in all cases. For small worlds in slow motion it
/// uses loose boxes, whose pairs seldom change.
///
/// How long loose boxes last is known only once boxes leave them. Each failed try doubles the number
/// of steps before the next one.
class AutomaticSearch final : public PairSearch {
public:
    explicit AutomaticSearch(const PairFilter& filter)
        : tree_(make_hub_search(make_tree_search(filter), filter)), loose_(filter) {}

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
        if (is_loose_ && loose_.try_update(step, list)) {
            // Boxes that all go elsewhere every few steps must not begin anew each time.
            if (++loose_steps_ >= kPaidOff)
                pause_ = kShortestPause;
            tree_is_current_ = false;
            return;
        }
        if (!tree_is_current_) {
            restart(step.boxes, list);
            return;
        }
        if (is_loose_)
            stay_with_tree();
        tree_->update(step, list);
        if (step.boxes.size() <= kMostBoxes && --left_ == 0) {
            loose_.begin(step.boxes);
            is_loose_ = true;
            loose_steps_ = 0;
        }
    }

private:
    /// Larger worlds are left to the tree, which several threads search.
    static constexpr std::size_t kMostBoxes = 1 << 14;
    static constexpr std::size_t kShortestPause = 4, kLongestPause = 64;
    /// Steps with loose boxes that are worth beginning with them.
    static constexpr std::size_t kPaidOff = 16;

    /// Loose boxes are tested in all pairs; the tree looks only at the boxes that have changed.
    void update_few(const BoxStep& step, PairList& list) {
        if (is_loose_)
            left_ = pause_; // so that steps that change by turns do not begin anew each time
        is_loose_ = false;
        left_ = std::max<std::size_t>(left_, 1);
        if (tree_is_current_)
            tree_->update(step, list);
        else
            tree_->restart(step.boxes, list);
        tree_is_current_ = true;
    }

    void stay_with_tree() {
        is_loose_ = false;
        pause_ = std::min(2 * pause_, kLongestPause);
        left_ = pause_;
    }

    std::unique_ptr<PairSearch> tree_;
    LooseSearch loose_;
    bool is_loose_ = false;
    std::size_t loose_steps_ = 0;        ///< since loose boxes were begun with
    bool tree_is_current_ = true;        ///< up to date with the last step
    std::size_t pause_ = kShortestPause; ///< steps with the tree after a failed try
    std::size_t left_ = kShortestPause;  ///< steps left until the next try
};

} // namespace

std::unique_ptr<PairSearch> make_automatic_search(const PairFilter& filter) {
    return std::make_unique<AutomaticSearch>(filter);
}

} // namespace abut
