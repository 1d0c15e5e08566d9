#include "world/broad_phase/hub_rows.h"
#include "world/broad_phase/pair_search.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace abut {

namespace {

/// Chooses hubs by the number of pairs of each box. The threshold for staying a hub is lower than
/// the one for becoming a hub.
std::vector<std::uint32_t> choose_hubs(std::span<const IndexPair> pairs, std::size_t boxes,
                                       const std::vector<std::uint32_t>& hubs) {
    // Measured in the least favourable case, in which all boxes move far. A row of bits then takes
    // as long as the pairs with a quarter of all boxes. Merging two lists takes as long as three
    // pairs for each box.
    constexpr std::size_t kShare = 4, kShareOfHub = 8, kPairs = 3, kPairsOfHubs = 2;
    const std::size_t least_pairs = boxes * (hubs.empty() ? kPairs : kPairsOfHubs);
    if (pairs.size() < least_pairs)
        return {};
    std::vector<std::uint32_t> degrees(boxes, 0), chosen;
    for (const IndexPair pair : pairs)
        ++degrees[pair.a()], ++degrees[pair.b()];
    std::size_t pairs_of_hubs = 0;
    for (std::uint32_t box = 0; box < boxes; ++box) {
        const bool is_hub = std::binary_search(hubs.begin(), hubs.end(), box);
        if (degrees[box] * (is_hub ? kShareOfHub : kShare) < boxes)
            continue;
        chosen.push_back(box);
        pairs_of_hubs += degrees[box];
    }
    return pairs_of_hubs < least_pairs ? std::vector<std::uint32_t>() : chosen;
}

/// Removes hubs from the boxes that another search sees, and handles them with HubRows.
class HubSearch final : public PairSearch {
public:
    HubSearch(std::unique_ptr<PairSearch> others, PairFilter filter)
        : search_(std::move(others)), filter_(std::move(filter)) {}

    void restart(std::span<const Box3> boxes, PairList& list) override {
        rows_.assign({}, {});
        search_->restart(boxes, list);
        is_current_ = true;
        chosen_ = choose_hubs(list.pairs(), boxes.size(), {});
        work_ = 0;
    }

    void update(const BoxStep& step, PairList& list) override {
        if (chosen_ != hubs() || (!chosen_.empty() && rows_.hubs().boxes() != step.boxes.size()))
            take_apart(step.boxes.size(), list);
        if (hubs().empty())
            search(step, list);
        else
            update_both(step, list);
        if (!(list.begun().empty() && list.ended().empty()))
            work_ += std::max<std::size_t>(step.changed.size(), 1);
        if (work_ >= kStepsOfChoice * step.boxes.size() && work_ > 0) {
            chosen_ = choose_hubs(list.pairs(), step.boxes.size(), hubs());
            work_ = 0;
        }
    }

private:
    /// Counting the pairs is cheap compared with this number of steps in which all boxes change.
    static constexpr std::size_t kStepsOfChoice = 16;

    [[nodiscard]] const std::vector<std::uint32_t>& hubs() const { return rows_.hubs().hubs(); }

    /// Splits the last step's pairs as if the newly chosen hubs had been the hubs then.
    void take_apart(std::size_t boxes, const PairList& list) {
        const bool are_others_same = chosen_ == hubs();
        rows_.assign({chosen_, boxes}, list.pairs());
        if (are_others_same)
            return;
        std::vector<IndexPair> others;
        std::copy_if(list.pairs().begin(), list.pairs().end(), std::back_inserter(others),
                     [&](IndexPair pair) { return !rows_.hubs().has(pair); });
        others_.assign(std::move(others));
        is_current_ = false;
    }

    void search(const BoxStep& step, PairList& list) {
        if (is_current_)
            search_->update(step, list);
        else
            search_->restart(step.boxes, list);
        is_current_ = true;
    }

    void update_both(const BoxStep& step, PairList& list) {
        hide_hubs(step);
        search({boxes_, step.changed}, others_);
        rows_.update(step, filter_);
        std::vector<IndexPair> begun, ended;
        rows_.begun().write(rows_.hubs(), others_.begun(), begun);
        rows_.ended().write(rows_.hubs(), others_.ended(), ended);
        if (begun.empty() && ended.empty()) {
            list.change({}, {});
            return;
        }
        rows_.pairs().write(rows_.hubs(), others_.pairs(), pairs_);
        list.replace(pairs_, std::move(begun), std::move(ended));
    }

    void hide_hubs(const BoxStep& step) {
        if (!is_current_ || step.all_changed()) {
            boxes_.assign(step.boxes.begin(), step.boxes.end());
        } else {
            boxes_.resize(step.boxes.size());
            for (const std::uint32_t box : step.changed)
                boxes_[box] = step.boxes[box];
        }
        for (const std::uint32_t hub : hubs())
            boxes_[hub] = Box3();
    }

    std::unique_ptr<PairSearch> search_; ///< for all boxes but hubs
    PairFilter filter_;
    bool is_current_ = false;           ///< whether `search_` is up to date with the last step
    std::vector<std::uint32_t> chosen_; ///< the hubs of the next step
    std::size_t work_ = 0;              ///< boxes that have changed since the last choice
    HubRows rows_;
    PairList others_;         ///< pairs without hubs; used only if there are hubs
    std::vector<Box3> boxes_; ///< the boxes, hubs replaced by empty ones
    std::vector<IndexPair> pairs_;
};

} // namespace

std::unique_ptr<PairSearch> make_hub_search(std::unique_ptr<PairSearch> others, PairFilter filter) {
    return std::make_unique<HubSearch>(std::move(others), std::move(filter));
}

} // namespace abut
