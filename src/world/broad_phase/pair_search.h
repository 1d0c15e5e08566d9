#pragma once

#include <abut/broad_phase.h>
#include <abut/types.h>

#include "world/broad_phase/pair_list.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace abut {

using PairFilter = std::function<bool(std::uint32_t, std::uint32_t)>;

/// The boxes of a step.
struct BoxStep {
    std::span<const Box3> boxes;
    /// The boxes that may have changed since the last step, or are new; each once.
    std::span<const std::uint32_t> changed;
    [[nodiscard]] bool all_changed() const { return changed.size() == boxes.size(); }
    /// Whether it is faster to move the changed boxes one after the other. The limit on their number
    /// leaves larger steps to several threads.
    [[nodiscard]] bool few_changed() const {
        constexpr std::size_t kFew = 8, kMost = 1 << 14;
        return changed.size() * kFew <= boxes.size() && changed.size() <= kMost;
    }
};

/// A method that keeps the list of overlapping pairs up to date.
class PairSearch {
public:
    PairSearch() = default;
    PairSearch(const PairSearch&) = delete;
    PairSearch& operator=(const PairSearch&) = delete;
    virtual ~PairSearch() = default;

    /// Updates `list` to this step. This search or another one has updated it to the last step. In:
    /// boxes without NaN.
    virtual void update(const BoxStep& step, PairList& list) = 0;
    /// Finds all pairs, independent of the last step.
    virtual void restart(std::span<const Box3> boxes, PairList& list) = 0;
};

/// Searches with a 16-ary tree over nodes of 16 boxes.
std::unique_ptr<PairSearch> make_tree_search(PairFilter filter);

/// Searches boxes sorted along one axis.
std::unique_ptr<PairSearch> make_sweep_search(PairFilter filter);

/// Searches boxes sorted along three axes.
std::unique_ptr<PairSearch> make_sweep_and_prune(PairFilter filter);

/// Handles hubs, which are boxes that meet a large share of all others, with rows of bits
/// (`hub_rows.h`). The other boxes are left to another search.
std::unique_ptr<PairSearch> make_hub_search(std::unique_ptr<PairSearch> others, PairFilter filter);

/// Chooses the method that suits each step.
std::unique_ptr<PairSearch> make_automatic_search(const PairFilter& filter);

} // namespace abut
