#include <abut/deformable.h>

#include "core/parallel.h"
#include "deform/deformable_data.h"
#include "deform/elementary_stages.h"
#include "deform/feature_pairs.h"
#include "deform/leaf_pairs.h"
#include "tree/traverse_overlaps.h"

#include <algorithm>
#include <atomic>
#include <tuple>

namespace abut {

namespace {

/// Enough that the longest does not keep others waiting.
constexpr std::size_t kTasks = 512;

/// Takes candidates through the elementary tests and keeps the impacts.
class ImpactCollector {
public:
    explicit ImpactCollector(const ElementaryOptions& options)
        : faces_(ElementaryKind::vertex_face, options, *this),
          edges_(ElementaryKind::edge_edge, options, *this) {}

    void operator()(const FeatureCandidate& candidate) {
        (candidate.kind == ElementaryKind::vertex_face ? faces_ : edges_).add(candidate);
    }
    void finish() {
        faces_.finish();
        edges_.finish();
    }
    [[nodiscard]] Impacts& impacts() { return impacts_; }

    // What the stages ask for.
    static void write(const FeatureCandidate& candidate, ElementaryBlock& block, std::size_t lane) {
        candidate.write(block, lane);
    }
    static ElementaryPair pair(const FeatureCandidate& candidate) { return candidate.pair(); }
    void take(const FeatureCandidate& candidate, const ElementaryImpact& impact) {
        TestCounts& tests = impacts_.counters.elementary_tests;
        ++(candidate.kind == ElementaryKind::vertex_face ? tests.vertex_face : tests.edge_edge);
        impacts_.counters.exact_fallbacks += impact.decided_by == ElementaryStage::exact ? 1 : 0;
        if (impact.hit)
            impacts_.list.push_back({candidate.kind, impact.status, candidate.face_first,
                                     candidate.a, candidate.b, impact.time, impact.barycentric,
                                     impact.normal});
    }

private:
    Impacts impacts_;
    ElementaryStages<FeatureCandidate, ImpactCollector> faces_, edges_;
};

void add(TestCounts& sum, const TestCounts& counts) {
    sum.vertex_face += counts.vertex_face;
    sum.edge_edge += counts.edge_edge;
}

void add(Impacts& sum, const Impacts& part) {
    sum.list.insert(sum.list.end(), part.list.begin(), part.list.end());
    sum.counters.triangle_pairs += part.counters.triangle_pairs;
    add(sum.counters.candidates, part.counters.candidates);
    add(sum.counters.elementary_tests, part.counters.elementary_tests);
    sum.counters.exact_fallbacks += part.counters.exact_fallbacks;
}

void sort(std::vector<FeatureImpact>& list) {
    const auto key = [](const FeatureImpact& i) {
        return std::tuple(i.kind, i.face_first, i.a, i.b);
    };
    std::sort(list.begin(), list.end(),
              [&](const FeatureImpact& a, const FeatureImpact& b) { return key(a) < key(b); });
}

Impacts find_impacts(const DeformableData& a, const DeformableData& b,
                     const ElementaryOptions& options) {
    require_valid(options);
    const OverlapTraversal traversal{a.swept.tree, b.swept.tree, 0};
    const auto starts = split_overlaps(traversal, kTasks);
    std::vector<Impacts> parts(starts.size());
    parallel_for(starts.size(), 1, [&](std::size_t i) {
        ImpactCollector collector(options);
        FeaturePairs<ImpactCollector> pairs(a, b, collector);
        RepresentativePairs<ImpactCollector> visitor(a.swept.leaves, b.swept.leaves, 0, pairs);
        traverse_overlaps(traversal, starts[i], visitor);
        collector.finish();
        parts[i] = std::move(collector.impacts());
        parts[i].counters.triangle_pairs = visitor.triangle_pairs();
        parts[i].counters.candidates = pairs.counts();
    });
    Impacts impacts;
    for (const Impacts& part : parts)
        add(impacts, part);
    sort(impacts.list);
    return impacts;
}

} // namespace

Impacts self_impacts(const Deformable& surface, const ElementaryOptions& options) {
    return find_impacts(surface.data(), surface.data(), options);
}

Impacts impacts(const Deformable& a, const Deformable& b, const ElementaryOptions& options) {
    return find_impacts(a.data(), b.data(), options);
}

} // namespace abut
