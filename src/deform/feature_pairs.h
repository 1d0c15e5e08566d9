#pragma once

#include <abut/deformable.h>

#include "ccd/elementary_batch.h"
#include "deform/deformable_data.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace abut {

/// Two features: a vertex and a triangle, or two edges.
struct FeatureIds {
    std::uint32_t a = 0, b = 0;
};

/// The lower number first. Written without a branch, which would be a coin toss for the edges of two
/// leaves.
inline FeatureIds in_order(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t change = (a ^ b) & (0U - static_cast<std::uint32_t>(b < a));
    return {a ^ change, b ^ change};
}

/// The sort key of a query's list, of FeatureImpact or FeaturePair: kind, face_first, a, b. No two
/// entries of a list have equal keys. Numbers of features are below 3 * 2^28, so 30 bits hold each.
template <typename Found>
std::uint64_t list_key(const Found& found) {
    return static_cast<std::uint64_t>(found.kind) << 61 | std::uint64_t{found.face_first} << 60 |
           std::uint64_t{found.a} << 30 | found.b;
}

/// What a list_key stands for.
struct KeyedPair {
    ElementaryKind kind;
    bool face_first;
    FeatureIds ids;

    explicit KeyedPair(std::uint64_t key)
        : kind(static_cast<ElementaryKind>(key >> 61)),
          face_first((key >> 60 & 1) != 0), ids{static_cast<std::uint32_t>(key >> 30 & kFeature),
                                                static_cast<std::uint32_t>(key & kFeature)} {}

private:
    static constexpr std::uint64_t kFeature = (std::uint64_t{1} << 30) - 1;
};

using PairVertices = std::array<const MovingVertex*, 4>; ///< in the order of ElementaryPair

inline ElementaryPair pair_of(ElementaryKind kind, const PairVertices& vertices) {
    ElementaryPair pair{kind, {}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
        pair.start[i] = vertices[i]->start;
        pair.end[i] = vertices[i]->end;
    }
    return pair;
}

/// The vertices of feature pairs of one kind, of two surfaces or of one.
template <ElementaryKind kind>
class PairGeometry {
public:
    PairGeometry(const DeformableData& a, const DeformableData& b) : a_(a), b_(b) {}

    [[nodiscard]] PairVertices vertices(FeatureIds ids) const {
        if constexpr (kind == ElementaryKind::edge_edge) {
            const auto &e = a_.features.edges[ids.a], &f = b_.features.edges[ids.b];
            return {&a_.vertices[e[0]], &a_.vertices[e[1]], &b_.vertices[f[0]], &b_.vertices[f[1]]};
        } else {
            const IndexTriangle& f = b_.triangles[ids.b];
            return {&a_.vertices[ids.a], &b_.vertices[f[0]], &b_.vertices[f[1]],
                    &b_.vertices[f[2]]};
        }
    }
    /// The vertices' numbers, in the order of ElementaryPair.
    [[nodiscard]] std::array<std::uint32_t, 4> indices(FeatureIds ids) const {
        if constexpr (kind == ElementaryKind::edge_edge) {
            const auto &e = a_.features.edges[ids.a], &f = b_.features.edges[ids.b];
            return {e[0], e[1], f[0], f[1]};
        } else {
            const IndexTriangle& f = b_.triangles[ids.b];
            return {ids.a, f[0], f[1], f[2]};
        }
    }
    [[nodiscard]] ElementaryPair pair(FeatureIds ids) const { return pair_of(kind, vertices(ids)); }
    void write(FeatureIds ids, ElementaryBatch& batch, std::size_t lane) const {
        const PairVertices v = vertices(ids);
        for (std::size_t i = 0; i < 4; ++i)
            batch.set_vertex(lane, i, v[i]->start, v[i]->end);
    }
    /// Whether two features of one surface share a vertex. Without branches: of the pairs of
    /// neighbouring leaves, about half do, which a processor cannot predict.
    [[nodiscard]] bool are_neighbours(FeatureIds ids) const {
        // As arithmetic, because g++ 12 turns comparisons that are combined by bits into branches.
        const auto differ = [](std::uint32_t u, std::uint32_t v) {
            const std::uint32_t bits = u ^ v;
            return (bits | (0U - bits)) >> 31;
        };
        if constexpr (kind == ElementaryKind::edge_edge) {
            const auto &e = a_.features.edges[ids.a], &f = b_.features.edges[ids.b];
            return (differ(e[0], f[0]) & differ(e[0], f[1]) & differ(e[1], f[0]) &
                    differ(e[1], f[1])) == 0;
        } else {
            const IndexTriangle& f = b_.triangles[ids.b];
            return (differ(f[0], ids.a) & differ(f[1], ids.a) & differ(f[2], ids.a)) == 0;
        }
    }

private:
    const DeformableData& a_; ///< the first feature's surface
    const DeformableData& b_;
};

/// The kinds of feature pairs between two surfaces a and b.
enum class PairKind : std::uint8_t {
    edges,       ///< an edge of each
    vertex_face, ///< a vertex of a and a face of b
    face_vertex, ///< a face of a and a vertex of b; within one surface, vertex_face is used instead
};

/// Hands pairs of features that share no vertex, by their ids, to a sink:
///
///     void Sink::add(PairKind, FeatureIds, bool wanted);  // does nothing if not wanted
///     bool Sink::is_done() const;                          // true: the search may stop
///
/// If both surfaces are the same object, the pairs are those of one surface with itself.
template <typename Sink>
class FeaturePairs {
public:
    FeaturePairs(const DeformableData& a, const DeformableData& b, Sink& sink)
        : is_self_(&a == &b), edges_(a, b), vertex_face_(a, b), face_vertex_(b, a), sink_(sink) {}

    [[nodiscard]] bool is_self() const { return is_self_; }
    [[nodiscard]] bool is_done() const { return sink_.is_done(); }
    [[nodiscard]] const TestCounts& counts() const { return counts_; }

    struct AdmitAll {
        bool operator()(PairKind, FeatureIds) const { return true; }
    };
    /// Two edges. In: admits, which tells whether to test a pair whose features share no vertex.
    template <typename Admits = AdmitAll>
    void edges(std::uint32_t a, std::uint32_t b, const Admits& admits = {}) {
        hand_over(PairKind::edges, is_self_ ? in_order(a, b) : FeatureIds{a, b}, edges_,
                  counts_.edge_edge, admits);
    }
    /// A vertex of the first surface and a face of the second.
    template <typename Admits = AdmitAll>
    void vertex_face(std::uint32_t vertex, std::uint32_t face, const Admits& admits = {}) {
        hand_over(PairKind::vertex_face, {vertex, face}, vertex_face_, counts_.vertex_face, admits);
    }
    /// A face of the first surface and a vertex of the second.
    template <typename Admits = AdmitAll>
    void face_vertex(std::uint32_t face, std::uint32_t vertex, const Admits& admits = {}) {
        hand_over(is_self_ ? PairKind::vertex_face : PairKind::face_vertex, {vertex, face},
                  face_vertex_, counts_.vertex_face, admits);
    }

private:
    template <ElementaryKind kind, typename Admits>
    void hand_over(PairKind pair_kind, FeatureIds ids, const PairGeometry<kind>& geometry,
                   std::uint64_t& count, const Admits& admits) {
        const bool wanted = !(is_self_ && geometry.are_neighbours(ids)) && admits(pair_kind, ids);
        count += wanted ? 1 : 0;
        sink_.add(pair_kind, ids, wanted);
    }

    bool is_self_;
    PairGeometry<ElementaryKind::edge_edge> edges_;
    PairGeometry<ElementaryKind::vertex_face> vertex_face_, face_vertex_;
    Sink& sink_;
    TestCounts counts_;
};

} // namespace abut
