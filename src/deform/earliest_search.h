#pragma once

#include <abut/deformable.h>

#include "deform/deformable_data.h"
#include "deform/leaf_boxes.h"
#include "tree/traverse_until.h"

#include <atomic>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// The part of the step in which impacts are still sought. It shrinks as impacts are found, by any
/// thread.
class TimeWindow {
public:
    /// In [0, 1]. An impact whose computed time is not later than that of any impact found so far
    /// has its contact until then.
    [[nodiscard]] double end() const { return end_.load(std::memory_order_relaxed); }
    /// The same, not less.
    [[nodiscard]] float until() const { return until_.load(std::memory_order_relaxed); }
    /// An impact has been found.
    void end_after(double time);

private:
    std::atomic<double> end_ = 1;
    std::atomic<float> until_ = 1;
};

/// Keeps the earliest impact; of several at the same time, the first in the order of a list.
struct EarliestImpact {
    std::optional<FeatureImpact> impact;

    void keep(const FeatureImpact& other);
};

/// Finds the earliest impact of two surfaces, or of one with itself. The search is divided into
/// runs, which may come in any order and on any thread; they share a window of time. Whatever a
/// window leaves out is proven to meet later than an impact that has been found.
class EarliestSearch {
public:
    /// In: all arguments must outlive this.
    EarliestSearch(const DeformableData& a, const DeformableData& b,
                   const ElementaryOptions& options);

    [[nodiscard]] const OverlapTraversal& traversal() const { return traversal_; }
    /// Searches below pairs of nodes. If `later` is not null, pairs that do not overlap at the
    /// start are added to it (see traverse_until) and remain to be searched.
    void run(std::span<const TimedPair> starts, TimeWindow& window, EarliestImpact& earliest,
             std::vector<TimedPair>* later) const;

private:
    const DeformableData& a_;
    const DeformableData& b_;
    const ElementaryOptions& options_;
    LeafSource leaves_a_, leaves_b_;
    /// Features that are reported as an impact at some time are at most this far apart then.
    double reach_;
    double slack_; ///< bounds what rounded positions add to the distance of two features
    OverlapTraversal traversal_;
};

} // namespace abut
