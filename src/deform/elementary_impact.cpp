#include <abut/elementary_impact.h>
#include <abut/error.h>

#include "core/parallel.h"
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
}

/// What the filter has left.
ElementaryImpact decide(const ElementaryPair& pair, const ElementaryOptions& options) {
    if (const auto impact = elementary_impact_interval(pair, options.delta))
        return *impact;
    return elementary_impact_exact(pair);
}

/// Gathers pairs of one kind until a pass of the filter is full.
class Batch {
public:
    Batch(ElementaryKind kind, std::span<const ElementaryPair> pairs,
          const ElementaryOptions& options, std::span<ElementaryImpact> impacts)
        : kind_(kind), pairs_(pairs), options_(options), impacts_(impacts) {}

    void add(std::size_t pair) {
        block_.set(count_, pairs_[pair]);
        members_[count_++] = pair;
        if (count_ == ElementaryBlock::kLanes)
            flush();
    }
    /// Lanes that are left from earlier passes are not looked at.
    void flush() {
        std::uint32_t possible = possible_impacts(block_, kind_) & ((1U << count_) - 1);
        for (; possible != 0; possible &= possible - 1) {
            const std::size_t i = members_[static_cast<std::size_t>(std::countr_zero(possible))];
            impacts_[i] = decide(pairs_[i], options_);
        }
        count_ = 0;
    }

private:
    ElementaryKind kind_;
    std::span<const ElementaryPair> pairs_;
    const ElementaryOptions& options_;
    std::span<ElementaryImpact> impacts_;
    ElementaryBlock block_;
    std::array<std::size_t, ElementaryBlock::kLanes> members_{};
    std::size_t count_ = 0;
};

} // namespace

ElementaryImpact elementary_impact(const ElementaryPair& pair, const ElementaryOptions& options) {
    require_valid(options);
    if (!is_finite(pair))
        throw Error(ErrorCode::bad_argument, "a coordinate is not finite");
    return possible_impact(pair) ? decide(pair, options) : ElementaryImpact{};
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
        faces.flush();
        edges.flush();
    });
    return impacts;
}

} // namespace abut
