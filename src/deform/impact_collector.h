#pragma once

#include <abut/deformable.h>

#include "deform/elementary_stages.h"
#include "deform/feature_pairs.h"

#include <cstddef>
#include <tuple>

namespace abut {

/// The order of impacts in a list: no two of a list are equal in it.
inline auto list_key(const FeatureImpact& impact) {
    return std::tuple(impact.kind, impact.face_first, impact.a, impact.b);
}

/// A sink of candidates (see FeaturePairs) that takes them through the elementary tests and hands
/// impacts to a keeper:
///
///     void Keeper::keep(const FeatureImpact&);
///     bool Keeper::is_done() const;  // no more, please
template <typename Keeper>
class ImpactCollector {
public:
    /// In: what lives as long as this.
    ImpactCollector(const ElementaryOptions& options, Keeper& keeper, DeformableCounters& counters)
        : keeper_(keeper), counters_(counters), faces_(ElementaryKind::vertex_face, options, *this),
          edges_(ElementaryKind::edge_edge, options, *this) {}

    void operator()(const FeatureCandidate& candidate) {
        (candidate.kind == ElementaryKind::vertex_face ? faces_ : edges_).add(candidate);
    }
    [[nodiscard]] bool is_done() const { return keeper_.is_done(); }
    /// Tests what still waits for others.
    void finish() {
        faces_.finish();
        edges_.finish();
    }

    // What the stages ask for.
    static void write(const FeatureCandidate& candidate, ElementaryBlock& block, std::size_t lane) {
        candidate.write(block, lane);
    }
    static ElementaryPair pair(const FeatureCandidate& candidate) { return candidate.pair(); }
    void take(const FeatureCandidate& candidate, const ElementaryImpact& impact) {
        TestCounts& tests = counters_.elementary_tests;
        ++(candidate.kind == ElementaryKind::vertex_face ? tests.vertex_face : tests.edge_edge);
        counters_.exact_fallbacks += impact.decided_by == ElementaryStage::exact ? 1 : 0;
        if (impact.hit)
            keeper_.keep({candidate.kind, impact.status, candidate.face_first, candidate.a,
                          candidate.b, impact.time, impact.barycentric, impact.normal});
    }

private:
    Keeper& keeper_;
    DeformableCounters& counters_;
    ElementaryStages<FeatureCandidate, ImpactCollector> faces_, edges_;
};

} // namespace abut
