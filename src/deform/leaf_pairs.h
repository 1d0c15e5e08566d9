#pragma once

#include "deform/feature_pairs.h"
#include "deform/triangle_pairs.h"
#include "tree/traverse_overlaps.h"
#include "volume/moving_box.h"

#include <array>
#include <cstdint>
#include <span>

namespace abut {

/// What leaves make of each other: candidates, straight away. A feature's boxes lie in those of the
/// triangle that represents it, so that pairs of triangles need no look of their own.
template <typename Sink>
class RepresentativePairs final : public OverlapVisitor {
public:
    RepresentativePairs(const LeafFeatures& a, const LeafFeatures& b, float margin,
                        FeaturePairs<Sink>& pairs)
        : a_(a), b_(b), margin_(margin), pairs_(pairs) {}

    [[nodiscard]] std::uint64_t triangle_pairs() const { return triangle_pairs_; }

    bool visit(const MovingLeaf& leaf_a, const MovingLeaf& leaf_b) override {
        const std::uint32_t i = leaf_a.number, j = leaf_b.number;
        const bool same = pairs_.is_self() && i == j;
        auto& [faces, edges, vertex_face, face_vertex] = overlaps_;
        faces.a = face_vertex.a = a_.faces.run(i), faces.b = vertex_face.b = b_.faces.run(j);
        edges.a = a_.edges.run(i), edges.b = b_.edges.run(j);
        vertex_face.a = a_.vertices.run(i), face_vertex.b = b_.vertices.run(j);
        find_overlaps(std::span(overlaps_).first(same ? 3 : 4), leaf_b.box, margin_);
        if (same)
            faces.keep_once(), edges.keep_once();
        triangle_pairs_ += faces.count();

        const auto all = [](const FeatureCandidate&) { return true; };
        edges.for_each([&](auto e, auto f) { pairs_.edges(e, f, all); });
        vertex_face.for_each([&](auto v, auto f) { pairs_.vertex_face(v, f, all); });
        if (!same)
            face_vertex.for_each([&](auto f, auto v) { pairs_.face_vertex(f, v, all); });
        return !pairs_.is_done();
    }

private:
    const LeafFeatures& a_;
    const LeafFeatures& b_;
    float margin_;
    FeaturePairs<Sink>& pairs_;
    std::uint64_t triangle_pairs_ = 0;
    std::array<RunOverlaps, 4> overlaps_;
};

/// The pairs of triangles of leaves.
class LeafTrianglePairs final : public OverlapVisitor {
public:
    LeafTrianglePairs(const LeafFeatures& a, const LeafFeatures& b, float margin,
                      TrianglePairVisitor& visitor)
        : a_(a), b_(b), margin_(margin), visitor_(visitor) {}

    bool visit(const MovingLeaf& leaf_a, const MovingLeaf& leaf_b) override {
        const std::uint32_t i = leaf_a.number, j = leaf_b.number;
        RunOverlaps faces{a_.faces.run(i), b_.faces.run(j), {}};
        find_overlaps({&faces, 1}, leaf_b.box, margin_);
        if (&a_ == &b_ && i == j)
            faces.keep_once();
        bool more = true;
        faces.for_each([&](auto f, auto g) { more = more && visitor_.visit(f, g); });
        return more;
    }

private:
    const LeafFeatures& a_;
    const LeafFeatures& b_;
    float margin_;
    TrianglePairVisitor& visitor_;
};

} // namespace abut
