#pragma once

#include "core/concurrent_set.h"
#include "deform/feature_pairs.h"
#include "mesh/representative_triangles.h"

#include <cstdint>

namespace abut {

/// Receives each pair of triangles whose boxes overlap once, of two surfaces or of one; never a
/// triangle with itself. visit() returns false to stop the search.
class TrianglePairVisitor {
public:
    TrianglePairVisitor() = default;
    TrianglePairVisitor(const TrianglePairVisitor&) = delete;
    TrianglePairVisitor& operator=(const TrianglePairVisitor&) = delete;
    virtual ~TrianglePairVisitor() = default;

    virtual bool visit(std::uint32_t a, std::uint32_t b) = 0;
};

/// Which of the 15 feature pairs of a triangle pair are candidates.
struct SpawnRules {
    bool represented = false;        ///< only features that the triangles represent
    bool boxes = false;              ///< only if the features' boxes overlap
    float margin = 0;                ///< widens these boxes
    ConcurrentSet* tested = nullptr; ///< if not null: only pairs not in this set, to which they are
                                     ///< added
};

/// Turns triangle pairs into candidate feature pairs.
template <typename Sink>
class TrianglePairs final : public TrianglePairVisitor {
public:
    TrianglePairs(const DeformableData& a, const DeformableData& b, const SpawnRules& rules,
                  FeaturePairs<Sink>& pairs)
        : a_(a), b_(b), rules_(rules), pairs_(pairs) {}

    [[nodiscard]] std::uint64_t count() const { return count_; }

    bool visit(std::uint32_t a, std::uint32_t b) override {
        ++count_;
        const auto admits = [this](PairKind kind, FeatureIds ids) {
            return this->admits(kind, ids);
        };
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                if (spawns_edge(a_, a, i) && spawns_edge(b_, b, k))
                    pairs_.edges(a_.features.edges_of[a][i], b_.features.edges_of[b][k], admits);
        for (std::size_t i = 0; i < 3; ++i)
            if (spawns_vertex(a_, a, i))
                pairs_.vertex_face(a_.triangles[a][i], b, admits);
        for (std::size_t i = 0; i < 3; ++i)
            if (spawns_vertex(b_, b, i))
                pairs_.face_vertex(a, b_.triangles[b][i], admits);
        return !pairs_.is_done();
    }

private:
    /// Whether a pair satisfies the rules on boxes and on tested pairs.
    [[nodiscard]] bool admits(PairKind kind, FeatureIds ids) const {
        if (rules_.boxes && are_apart(kind, ids))
            return false;
        return rules_.tested == nullptr || rules_.tested->insert(key(kind, ids));
    }
    [[nodiscard]] bool are_apart(PairKind kind, FeatureIds ids) const {
        const double margin{rules_.margin};
        if (kind == PairKind::edges)
            return boxes_apart(ElementaryKind::edge_edge,
                               PairGeometry<ElementaryKind::edge_edge>(a_, b_).vertices(ids),
                               margin);
        const bool face_first = kind == PairKind::face_vertex;
        return boxes_apart(
            ElementaryKind::vertex_face,
            PairGeometry<ElementaryKind::vertex_face>(face_first ? b_ : a_, face_first ? a_ : b_)
                .vertices(ids),
            margin);
    }
    [[nodiscard]] bool spawns_edge(const DeformableData& of, std::uint32_t triangle,
                                   std::size_t k) const {
        return of.features.edges_of[triangle][k] != kNoEdge &&
               (!rules_.represented || represents_edge(of.represented[triangle], k));
    }
    [[nodiscard]] bool spawns_vertex(const DeformableData& of, std::uint32_t triangle,
                                     std::size_t k) const {
        return !rules_.represented || represents_vertex(of.represented[triangle], k);
    }
    /// Features' numbers are below 3 * 2^28, so that 30 bits hold each.
    static std::uint64_t key(PairKind kind, FeatureIds ids) {
        return static_cast<std::uint64_t>(kind) << 60 | std::uint64_t{ids.a} << 30 | ids.b;
    }

    const DeformableData& a_;
    const DeformableData& b_;
    SpawnRules rules_;
    FeaturePairs<Sink>& pairs_;
    std::uint64_t count_ = 0;
};

} // namespace abut
