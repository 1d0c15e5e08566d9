#include <abut/deformable.h>

#include "core/parallel.h"
#include "deform/candidate_search.h"
#include "deform/deformable_data.h"
#include "deform/elementary_stages.h"

#include <algorithm>
#include <tuple>

namespace abut {

namespace {

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
    static bool is_done() { return false; }
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
    // Schemes without representatives find some several times.
    list.erase(std::unique(list.begin(), list.end(),
                           [&](const FeatureImpact& a, const FeatureImpact& b) {
                               return key(a) == key(b);
                           }),
               list.end());
}

Impacts find_impacts(const DeformableData& a, const DeformableData& b,
                     const ElementaryOptions& options) {
    require_valid(options);
    const CandidateSearch search(a, b, 0);
    std::vector<Impacts> parts(search.tasks());
    parallel_for(parts.size(), 1, [&](std::size_t i) {
        ImpactCollector collector(options);
        search.run(i, collector, collector.impacts().counters);
        collector.finish();
        parts[i] = std::move(collector.impacts());
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
