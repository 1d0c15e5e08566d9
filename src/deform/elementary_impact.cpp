#include <abut/elementary_impact.h>
#include <abut/error.h>

#include "core/parallel.h"
#include "geometry/difference_patch.h"
#include "geometry/elementary_advancement.h"
#include "geometry/elementary_crossing.h"
#include "geometry/elementary_exact.h"
#include "geometry/elementary_filter.h"
#include "geometry/elementary_interval.h"
#include "math/vector.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace abut {

namespace {

/// Pairs that one task takes.
constexpr std::size_t kPairsOfTask = 1024;

bool is_finite(const ElementaryPair& pair) {
    const auto finite = [](const Vec3& p) { return is_finite(p); };
    return std::all_of(pair.start.begin(), pair.start.end(), finite) &&
           std::all_of(pair.end.begin(), pair.end.end(), finite);
}

void require_valid(const ElementaryOptions& options) {
    if (!(options.delta >= 0 && std::isfinite(options.delta)))
        throw Error(ErrorCode::bad_argument, "delta must be a finite number of at least 0");
    if (!(options.thickness >= 0 && std::isfinite(options.thickness)))
        throw Error(ErrorCode::bad_argument, "thickness must be a finite number of at least 0");
}

ElementaryImpact impact_of(const ElementaryPair& pair, const CrossingBlock& crossings,
                           std::size_t lane) {
    ElementaryImpact impact;
    impact.decided_by = ElementaryStage::interval;
    if ((crossings.meet >> lane & 1) == 0)
        return impact;
    impact.hit = true;
    impact.time = crossings.time[lane];
    impact.barycentric = patch_barycentric(pair.kind, crossings.x[lane], crossings.y[lane]);
    impact.normal = impact_normal(
        pair, impact.barycentric,
        {crossings.normal[0][lane], crossings.normal[1][lane], crossings.normal[2][lane]}, {});
    return impact;
}

/// What filter and crossings have left.
ElementaryImpact decide(const ElementaryPair& pair, const ElementaryOptions& options) {
    if (const auto impact = elementary_impact_interval(pair, options.delta))
        return *impact;
    return elementary_impact_exact(pair);
}

/// Pairs of one kind, gathered until a pass over a block is full.
struct Gathered {
    ElementaryBlock block;
    std::array<std::size_t, ElementaryBlock::kLanes> members{};
    std::size_t count = 0;

    /// True if it is full now.
    bool add(std::size_t index, const ElementaryPair& pair) {
        block.set(count, pair);
        members[count++] = index;
        return count == ElementaryBlock::kLanes;
    }
    /// Lanes beyond are left from earlier passes.
    [[nodiscard]] std::uint32_t used() const { return (1U << count) - 1; }
};

template <typename Visit>
void for_each_bit(std::uint32_t bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1)
        visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

/// Takes pairs of one kind through the stages: those that one has left wait for the next.
class Batch {
public:
    Batch(ElementaryKind kind, std::span<const ElementaryPair> pairs,
          const ElementaryOptions& options, std::span<ElementaryImpact> impacts)
        : kind_(kind), pairs_(pairs), options_(options), impacts_(impacts) {}

    void add(std::size_t pair) {
        if (candidates_.add(pair, pairs_[pair]))
            filter();
    }
    void finish() {
        filter();
        cross();
    }

private:
    void filter() {
        for_each_bit(possible_impacts(candidates_.block, kind_, options_.thickness) &
                         candidates_.used(),
                     [&](std::size_t lane) { pass(candidates_.members[lane]); });
        candidates_.count = 0;
    }
    /// What the filter has left.
    void pass(std::size_t i) {
        if (options_.thickness > 0)
            impacts_[i] =
                elementary_impact_advancement(pairs_[i], options_.thickness, options_.delta);
        else if (possible_.add(i, pairs_[i]))
            cross();
    }
    void cross() {
        decide_crossings(possible_.block, kind_, crossings_);
        const std::uint32_t decided = crossings_.apart | crossings_.meet;
        for_each_bit(possible_.used(), [&](std::size_t lane) {
            const std::size_t i = possible_.members[lane];
            impacts_[i] = (decided >> lane & 1) != 0 ? impact_of(pairs_[i], crossings_, lane)
                                                     : decide(pairs_[i], options_);
        });
        possible_.count = 0;
    }

    ElementaryKind kind_;
    std::span<const ElementaryPair> pairs_;
    const ElementaryOptions& options_;
    std::span<ElementaryImpact> impacts_;
    Gathered candidates_, possible_;
    CrossingBlock crossings_;
};

} // namespace

ElementaryImpact elementary_impact(const ElementaryPair& pair, const ElementaryOptions& options) {
    require_valid(options);
    if (!is_finite(pair))
        throw Error(ErrorCode::bad_argument, "a coordinate is not finite");
    if (!possible_impact(pair, options.thickness))
        return {};
    if (options.thickness > 0)
        return elementary_impact_advancement(pair, options.thickness, options.delta);
    CrossingBlock crossing;
    decide_crossing(pair, crossing);
    return (crossing.apart | crossing.meet) != 0 ? impact_of(pair, crossing, 0)
                                                 : decide(pair, options);
}

std::vector<ElementaryImpact> elementary_impacts(std::span<const ElementaryPair> pairs,
                                                 const ElementaryOptions& options) {
    require_valid(options);
    const auto invalid = std::find_if_not(pairs.begin(), pairs.end(),
                                          [](const ElementaryPair& p) { return is_finite(p); });
    if (invalid != pairs.end())
        throw Error(ErrorCode::bad_argument, "pair " + std::to_string(invalid - pairs.begin()) +
                                                 ": a coordinate is not finite");
    std::vector<ElementaryImpact> impacts(pairs.size());
    const std::size_t tasks = (pairs.size() + kPairsOfTask - 1) / kPairsOfTask;
    parallel_for(tasks, 1, [&](std::size_t task) {
        Batch faces(ElementaryKind::vertex_face, pairs, options, impacts),
            edges(ElementaryKind::edge_edge, pairs, options, impacts);
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
