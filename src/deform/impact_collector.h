#pragma once

#include <abut/deformable.h>

#include "ccd/elementary_stages.h"
#include "deform/feature_pairs.h"

#include <cstddef>
#include <cstdint>

namespace abut {

/// Tests pairs of one kind and hands their impacts to a keeper. The source of the elementary
/// stages.
template <ElementaryKind kind, typename Keeper>
class PairTests {
public:
    PairTests(const DeformableData& a, const DeformableData& b, bool face_first,
              const ElementaryOptions& options, Keeper& keeper)
        : geometry_(a, b), face_first_(face_first), keeper_(keeper), stages_(kind, options, *this) {
    }
    PairTests(const PairTests&) = delete; // the stages hold a reference to this
    PairTests& operator=(const PairTests&) = delete;

    void add(FeatureIds ids, bool wanted) { stages_.add(ids, wanted); }
    void finish() { stages_.finish(); }
    [[nodiscard]] std::uint64_t tests() const { return tests_; }
    [[nodiscard]] std::uint64_t exact_fallbacks() const { return exact_fallbacks_; }

    // The interface that ElementaryStages requires of its source.
    void write(FeatureIds ids, ElementaryBatch& batch, std::size_t lane) const {
        geometry_.write(ids, batch, lane);
    }
    [[nodiscard]] ElementaryPair pair(FeatureIds ids) const { return geometry_.pair(ids); }
    void take(FeatureIds ids, const ElementaryImpact& impact) {
        ++tests_;
        exact_fallbacks_ += impact.decided_by == ElementaryStage::exact ? 1 : 0;
        if (impact.meet)
            keeper_.keep({kind, impact.status, face_first_, ids.a, ids.b, impact.time,
                          impact.barycentric, impact.normal});
    }

private:
    PairGeometry<kind> geometry_;
    bool face_first_;
    Keeper& keeper_;
    std::uint64_t tests_ = 0, exact_fallbacks_ = 0;
    ElementaryStages<FeatureIds, PairTests> stages_;
};

/// A sink of pairs (see FeaturePairs) that runs the elementary tests and hands the impacts to a
/// keeper:
///
///     void Keeper::keep(const FeatureImpact&);
///     bool Keeper::is_done() const;  // true: the search may stop
template <typename Keeper>
class ImpactCollector {
public:
    /// In: all arguments must outlive this.
    ImpactCollector(const DeformableData& a, const DeformableData& b,
                    const ElementaryOptions& options, Keeper& keeper)
        : keeper_(keeper), edges_(a, b, false, options, keeper),
          vertex_face_(a, b, false, options, keeper), face_vertex_(b, a, true, options, keeper) {}

    void add(PairKind kind, FeatureIds ids, bool wanted) {
        if (kind == PairKind::edges)
            edges_.add(ids, wanted);
        else
            (kind == PairKind::vertex_face ? vertex_face_ : face_vertex_).add(ids, wanted);
    }
    [[nodiscard]] bool is_done() const { return keeper_.is_done(); }
    /// Tests the pairs that still wait for a full batch.
    void finish() {
        edges_.finish();
        vertex_face_.finish();
        face_vertex_.finish();
    }
    void count(DeformableCounters& counters) const {
        counters.elementary_tests = {vertex_face_.tests() + face_vertex_.tests(), edges_.tests()};
        counters.exact_fallbacks = edges_.exact_fallbacks() + vertex_face_.exact_fallbacks() +
                                   face_vertex_.exact_fallbacks();
    }

private:
    Keeper& keeper_;
    PairTests<ElementaryKind::edge_edge, Keeper> edges_;
    PairTests<ElementaryKind::vertex_face, Keeper> vertex_face_, face_vertex_;
};

} // namespace abut
