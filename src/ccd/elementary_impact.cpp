#include <abut/elementary_impact.h>
#include <abut/error.h>

#include "ccd/elementary_crossing.h"
#include "ccd/elementary_filter.h"
#include "ccd/elementary_stages.h"
#include "core/parallel.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace abut {

namespace {

constexpr std::size_t kPairsOfTask = 1024;

bool is_finite(const ElementaryPair& pair) {
    const auto finite = [](const Vec3& p) { return is_finite(p); };
    return std::all_of(pair.start.begin(), pair.start.end(), finite) &&
           std::all_of(pair.end.begin(), pair.end.end(), finite);
}

/// The pairs of a list, addressed by their indices. A source for ElementaryStages.
struct ListedPairs {
    std::span<const ElementaryPair> pairs;
    std::span<ElementaryImpact> impacts;

    void write(std::size_t i, ElementaryBatch& batch, std::size_t lane) const {
        batch.set(lane, pairs[i]);
    }
    [[nodiscard]] const ElementaryPair& pair(std::size_t i) const { return pairs[i]; }
    void take(std::size_t i, const ElementaryImpact& impact) { impacts[i] = impact; }
};

} // namespace

ElementaryImpact elementary_impact(const ElementaryPair& pair, const ElementaryOptions& options) {
    require_valid(options);
    if (!is_finite(pair))
        throw Error(ErrorCode::bad_argument, "a coordinate is not finite");
    if (!possible_impact(pair, options.thickness))
        return {};
    if (options.thickness > 0)
        return decide_singly(pair, options);
    CrossingBatch crossing;
    decide_crossing(pair, crossing);
    return (crossing.apart | crossing.meet) != 0 ? impact_of_crossing(pair, crossing, 0)
                                                 : decide_singly(pair, options);
}

std::vector<ElementaryImpact> elementary_impacts(std::span<const ElementaryPair> pairs,
                                                 const ElementaryOptions& options,
                                                 const Progress& progress) {
    require_valid(options);
    const StopScope stopping(progress);
    const auto invalid = std::find_if_not(pairs.begin(), pairs.end(),
                                          [](const ElementaryPair& p) { return is_finite(p); });
    if (invalid != pairs.end())
        throw Error(ErrorCode::bad_argument, "pair " + std::to_string(invalid - pairs.begin()) +
                                                 ": a coordinate is not finite");
    std::vector<ElementaryImpact> impacts(pairs.size());
    const std::size_t tasks = (pairs.size() + kPairsOfTask - 1) / kPairsOfTask;
    parallel_for(tasks, 1, [&](std::size_t task) {
        ListedPairs source{pairs, impacts};
        ElementaryStages<std::size_t, ListedPairs> faces(ElementaryKind::vertex_face, options,
                                                         source),
            edges(ElementaryKind::edge_edge, options, source);
        const std::size_t begin = task * kPairsOfTask,
                          end = std::min(begin + kPairsOfTask, pairs.size());
        for (std::size_t i = begin; i < end; ++i)
            (pairs[i].kind == ElementaryKind::vertex_face ? faces : edges).add(i);
        faces.finish();
        edges.finish();
    });
    return impacts;
}

} // namespace abut
