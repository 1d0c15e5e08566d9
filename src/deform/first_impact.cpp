#include <abut/deformable.h>

#include "core/parallel.h"
#include "deform/candidate_search.h"
#include "deform/earliest_search.h"
#include "deform/impact_collector.h"
#include "tree/traverse_until.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <span>
#include <vector>

namespace abut {

namespace {

/// Pairs of nodes that a thread takes at once.
constexpr std::size_t kLaterPairsAtOnce = 64;

/// What one task has found.
struct Part {
    EarliestImpact earliest;
    std::vector<TimedPair> later; ///< pairs of nodes that do not overlap at the start
};

/// The pairs of all tasks that may overlap before the window ends, the first ones first.
std::vector<TimedPair> pairs_until(std::vector<Part>& parts, float until) {
    std::vector<TimedPair> all;
    for (Part& part : parts) {
        std::copy_if(part.later.begin(), part.later.end(), std::back_inserter(all),
                     [&](const TimedPair& pair) { return pair.first <= until; });
        part.later = std::vector<TimedPair>();
    }
    std::sort(all.begin(), all.end(),
              [](const TimedPair& p, const TimedPair& q) { return p.first < q.first; });
    return all;
}

/// Pairs that overlap at the start come first: they cannot be ruled out, and most early impacts are
/// among them. The others follow in the order of time, until the earliest impact found so far.
std::optional<FeatureImpact> find_first(const DeformableData& a, const DeformableData& b,
                                        const ElementaryOptions& options,
                                        const Progress& progress) {
    require_valid(options);
    const StopScope stopping(progress);
    const EarliestSearch search(a, b, options);
    const std::vector<OverlapTraversal::Pair> starts =
        split_overlaps(search.traversal(), kSearchTasks);
    TimeWindow window;
    std::vector<Part> parts(starts.size());
    parallel_for(starts.size(), 1, [&](std::size_t i) {
        const TimedPair start{starts[i], 0};
        search.run({&start, 1}, window, parts[i].earliest, &parts[i].later);
    });
    const std::vector<TimedPair> later = pairs_until(parts, window.until());
    std::vector<EarliestImpact> earliest((later.size() + kLaterPairsAtOnce - 1) /
                                         kLaterPairsAtOnce);
    parallel_for(earliest.size(), 1, [&](std::size_t i) {
        const std::size_t first = i * kLaterPairsAtOnce;
        const std::size_t count = std::min(kLaterPairsAtOnce, later.size() - first);
        search.run(std::span(later).subspan(first, count), window, earliest[i], nullptr);
    });
    for (const Part& part : parts)
        earliest.push_back(part.earliest);
    EarliestImpact all;
    for (const EarliestImpact& each : earliest)
        if (each.impact)
            all.keep(*each.impact);
    return all.impact;
}

/// Whether any task has found an impact.
struct AnyImpact {
    std::atomic<bool>& found;

    void keep(const FeatureImpact&) { found = true; }
    [[nodiscard]] bool is_done() const { return found.load(std::memory_order_relaxed); }
};

bool is_free(const DeformableData& a, const DeformableData& b, const ElementaryOptions& options,
             const Progress& progress) {
    require_valid(options);
    const StopScope stopping(progress);
    const CandidateSearch search(a, a.swept, b, b.swept, options.thickness);
    std::atomic<bool> found = false;
    search.for_each_task([&](std::size_t i) {
        AnyImpact keeper{found};
        if (keeper.is_done())
            return;
        ImpactCollector<AnyImpact> collector(a, b, options, keeper);
        search.run(i, collector);
        collector.finish();
    });
    return !found;
}

} // namespace

std::optional<FeatureImpact> self_time_of_impact(const Deformable& surface,
                                                 const ElementaryOptions& options,
                                                 const Progress& progress) {
    return find_first(surface.data(), surface.data(), options, progress);
}
std::optional<FeatureImpact> time_of_impact(const Deformable& a, const Deformable& b,
                                            const ElementaryOptions& options,
                                            const Progress& progress) {
    return find_first(a.data(), b.data(), options, progress);
}

bool is_free_of_self_impacts(const Deformable& surface, const ElementaryOptions& options,
                             const Progress& progress) {
    return is_free(surface.data(), surface.data(), options, progress);
}
bool is_free_of_impacts(const Deformable& a, const Deformable& b, const ElementaryOptions& options,
                        const Progress& progress) {
    return is_free(a.data(), b.data(), options, progress);
}

} // namespace abut
