#pragma once

#include <abut/broad_phase.h>
#include <abut/types.h>

#include "world/pair_list.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace abut {

using PairFilter = std::function<bool(std::uint32_t, std::uint32_t)>;

/// The boxes of a step.
struct BoxStep {
    std::span<const Box3> boxes;
    /// Those that may have changed since the last step, or are new; each once.
    std::span<const std::uint32_t> changed;
    [[nodiscard]] bool all_changed() const { return changed.size() == boxes.size(); }
};

/// One way to keep the list of overlapping pairs up to date.
class PairSearch {
public:
    PairSearch() = default;
    PairSearch(const PairSearch&) = delete;
    PairSearch& operator=(const PairSearch&) = delete;
    virtual ~PairSearch() = default;

    /// Brings `list`, which this search or another has brought up to date in the last step, to this
    /// step. In: boxes without NaN.
    virtual void update(const BoxStep& step, PairList& list) = 0;
    /// Finds all pairs, whatever was before.
    virtual void restart(std::span<const Box3> boxes, PairList& list) = 0;
};

/// A 16-ary tree over blocks of 16 boxes.
std::unique_ptr<PairSearch> make_tree_search(PairFilter wanted);

/// Sorted along one axis.
std::unique_ptr<PairSearch> make_sweep_search(PairFilter wanted);

/// Sorted along three axes.
std::unique_ptr<PairSearch> make_sweep_and_prune(PairFilter wanted);

/// Hubs, boxes that meet a large share of all others, by rows of bits (`hub_rows.h`); all others by
/// another search.
std::unique_ptr<PairSearch> make_hub_search(std::unique_ptr<PairSearch> others, PairFilter wanted);

/// The one of these that suits the step.
std::unique_ptr<PairSearch> make_automatic_search(const PairFilter& wanted);

} // namespace abut
