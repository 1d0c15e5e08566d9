#pragma once

#include <abut/deformable.h>

#include "deform/deformable_data.h"
#include "geometry/elementary_block.h"

#include <array>
#include <cstddef>
#include <cstdint>

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

/// Makes candidates of features that are no neighbours, by their ids, and hands them to a sink:
///
///     void Sink::operator()(const FeatureCandidate&)
///
/// One surface against itself if both are the same object.
template <typename Sink>
class FeaturePairs {
public:
    FeaturePairs(const DeformableData& a, const DeformableData& b, Sink& sink)
        : a_(a), b_(b), is_self_(&a == &b), sink_(sink) {}

    [[nodiscard]] bool is_self() const { return is_self_; }
    [[nodiscard]] const TestCounts& counts() const { return counts_; }

    void edges(std::uint32_t a, std::uint32_t b) {
        if (is_self_ && a > b)
            std::swap(a, b);
        const auto &e = a_.features.edges[a], &f = b_.features.edges[b];
        if (is_self_ && (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]))
            return;
        ++counts_.edge_edge;
        sink_(FeatureCandidate{
            ElementaryKind::edge_edge,
            false,
            a,
            b,
            {&a_.vertices[e[0]], &a_.vertices[e[1]], &b_.vertices[f[0]], &b_.vertices[f[1]]}});
    }
    /// A vertex of the first surface and a face of the second.
    void vertex_face(std::uint32_t vertex, std::uint32_t face) { add(a_, vertex, b_, face, false); }
    /// A face of the first surface and a vertex of the second.
    void face_vertex(std::uint32_t face, std::uint32_t vertex) {
        add(b_, vertex, a_, face, !is_self_);
    }

private:
    void add(const DeformableData& of_vertex, std::uint32_t vertex, const DeformableData& of_face,
             std::uint32_t face, bool face_first) {
        const IndexTriangle& f = of_face.triangles[face];
        if (is_self_ && (f[0] == vertex || f[1] == vertex || f[2] == vertex))
            return;
        ++counts_.vertex_face;
        sink_(FeatureCandidate{ElementaryKind::vertex_face,
                               face_first,
                               vertex,
                               face,
                               {&of_vertex.vertices[vertex], &of_face.vertices[f[0]],
                                &of_face.vertices[f[1]], &of_face.vertices[f[2]]}});
    }

    const DeformableData& a_;
    const DeformableData& b_;
    bool is_self_;
    Sink& sink_;
    TestCounts counts_;
};

} // namespace abut
