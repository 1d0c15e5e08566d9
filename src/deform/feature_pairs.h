#pragma once

#include <abut/deformable.h>

#include "deform/deformable_data.h"
#include "geometry/elementary_block.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace abut {

/// Two features of surfaces, and their four moving vertices in the order of ElementaryPair.
struct FeatureCandidate {
    ElementaryKind kind = ElementaryKind::vertex_face;
    bool face_first = false;    ///< as in FeatureImpact
    std::uint32_t a = 0, b = 0; ///< as in FeatureImpact
    std::array<const MovingVertex*, 4> vertices{};

    void write(ElementaryBlock& block, std::size_t lane) const {
        for (std::size_t i = 0; i < 4; ++i)
            block.set_vertex(lane, i, vertices[i]->start, vertices[i]->end);
    }
    [[nodiscard]] ElementaryPair pair() const {
        ElementaryPair pair{kind, {}, {}};
        for (std::size_t i = 0; i < 4; ++i) {
            pair.start[i] = vertices[i]->start;
            pair.end[i] = vertices[i]->end;
        }
        return pair;
    }
};

/// Whether the boxes of both features, at both ends of the motion, show them farther apart than a
/// margin on some axis, always.
inline bool boxes_apart(const FeatureCandidate& c, double margin) {
    const std::size_t first = c.kind == ElementaryKind::vertex_face ? 1 : 2;
    for (int axis = 0; axis < 3; ++axis) {
        bool below = true, above = true;
        for (const auto end : {&MovingVertex::start, &MovingVertex::end}) {
            double low[2], high[2];
            for (const std::size_t side : {0U, 1U}) {
                const std::size_t begin = side == 0 ? 0 : first, stop = side == 0 ? first : 4;
                low[side] = high[side] = component(c.vertices[begin]->*end, axis);
                for (std::size_t i = begin + 1; i < stop; ++i) {
                    const double x = component(c.vertices[i]->*end, axis);
                    low[side] = std::min(low[side], x);
                    high[side] = std::max(high[side], x);
                }
            }
            // A rounded difference is below a double only if the exact one is.
            below = below && high[0] - low[1] < -margin;
            above = above && high[1] - low[0] < -margin;
        }
        if (below || above)
            return true;
    }
    return false;
}

/// Makes candidates of features that are no neighbours, by their ids, and hands those that a
/// predicate admits to a sink:
///
///     void Sink::operator()(const FeatureCandidate&);
///     bool Sink::is_done() const;  // no more, please
///
/// One surface against itself if both are the same object.
template <typename Sink>
class FeaturePairs {
public:
    FeaturePairs(const DeformableData& a, const DeformableData& b, Sink& sink)
        : a_(a), b_(b), is_self_(&a == &b), sink_(sink) {}

    [[nodiscard]] bool is_self() const { return is_self_; }
    [[nodiscard]] bool is_done() const { return sink_.is_done(); }
    [[nodiscard]] const TestCounts& counts() const { return counts_; }

    template <typename Admits>
    void edges(std::uint32_t a, std::uint32_t b, const Admits& admits) {
        if (is_self_ && a > b)
            std::swap(a, b);
        const auto &e = a_.features.edges[a], &f = b_.features.edges[b];
        if (is_self_ && (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]))
            return;
        hand_over(FeatureCandidate{ElementaryKind::edge_edge,
                                   false,
                                   a,
                                   b,
                                   {&a_.vertices[e[0]], &a_.vertices[e[1]], &b_.vertices[f[0]],
                                    &b_.vertices[f[1]]}},
                  counts_.edge_edge, admits);
    }
    /// A vertex of the first surface and a face of the second.
    template <typename Admits>
    void vertex_face(std::uint32_t vertex, std::uint32_t face, const Admits& admits) {
        vertex_face(a_, vertex, b_, face, false, admits);
    }
    /// A face of the first surface and a vertex of the second.
    template <typename Admits>
    void face_vertex(std::uint32_t face, std::uint32_t vertex, const Admits& admits) {
        vertex_face(b_, vertex, a_, face, !is_self_, admits);
    }

private:
    template <typename Admits>
    void vertex_face(const DeformableData& of_vertex, std::uint32_t vertex,
                     const DeformableData& of_face, std::uint32_t face, bool face_first,
                     const Admits& admits) {
        const IndexTriangle& f = of_face.triangles[face];
        if (is_self_ && (f[0] == vertex || f[1] == vertex || f[2] == vertex))
            return;
        hand_over(FeatureCandidate{ElementaryKind::vertex_face,
                                   face_first,
                                   vertex,
                                   face,
                                   {&of_vertex.vertices[vertex], &of_face.vertices[f[0]],
                                    &of_face.vertices[f[1]], &of_face.vertices[f[2]]}},
                  counts_.vertex_face, admits);
    }
    template <typename Admits>
    void hand_over(const FeatureCandidate& candidate, std::uint64_t& count, const Admits& admits) {
        if (!admits(candidate))
            return;
        ++count;
        sink_(candidate);
    }

    const DeformableData& a_;
    const DeformableData& b_;
    bool is_self_;
    Sink& sink_;
    TestCounts counts_;
};

} // namespace abut
