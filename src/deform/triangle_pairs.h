#pragma once

#include "core/concurrent_set.h"
#include "deform/feature_boxes.h"
#include "deform/feature_pairs.h"
#include "mesh/representative_triangles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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
        if (rules_.tested == nullptr)
            spawn(a, b, [this](PairKind kind, FeatureIds ids) { return may_meet(kind, ids); });
        else
            spawn_untested(a, b);
        return !pairs_.is_done();
    }

private:
    /// A feature pair that has to be looked up.
    struct Lookup {
        PairKind kind = PairKind::edges;
        FeatureIds ids;
    };

    template <typename Admits>
    void spawn(std::uint32_t a, std::uint32_t b, const Admits& admits) {
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
    }
    /// Fetches the table's entries for all feature pairs before it looks at the first one, so that
    /// one wait for memory serves them all.
    void spawn_untested(std::uint32_t a, std::uint32_t b) {
        std::array<Lookup, 15> lookups;
        std::size_t count = 0;
        spawn(a, b, [&](PairKind kind, FeatureIds ids) {
            if (may_meet(kind, ids)) {
                rules_.tested->prefetch(key(kind, ids));
                lookups[count++] = {kind, ids};
            }
            return false;
        });
        const auto is_new = [this](PairKind kind, FeatureIds ids) {
            return rules_.tested->insert(key(kind, ids));
        };
        for (const Lookup& each : std::span(lookups).first(count))
            if (each.kind == PairKind::edges)
                pairs_.edges(each.ids.a, each.ids.b, is_new);
            else if (each.kind == PairKind::vertex_face)
                pairs_.vertex_face(each.ids.a, each.ids.b, is_new);
            else
                pairs_.face_vertex(each.ids.b, each.ids.a, is_new);
    }
    [[nodiscard]] bool may_meet(PairKind kind, FeatureIds ids) const {
        return !rules_.boxes || !are_apart(kind, ids);
    }
    [[nodiscard]] bool are_apart(PairKind kind, FeatureIds ids) const {
        const FeatureBoxes &a = *a_.feature_boxes, &b = *b_.feature_boxes;
        if (kind == PairKind::edges)
            return abut::are_apart(a.edges[ids.a], b.edges[ids.b], rules_.margin);
        if (kind == PairKind::vertex_face)
            return abut::are_apart(a.vertices[ids.a], b.faces[ids.b], rules_.margin);
        return abut::are_apart(b.vertices[ids.a], a.faces[ids.b], rules_.margin);
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
