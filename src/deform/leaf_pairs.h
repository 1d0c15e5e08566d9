#pragma once

#include "deform/feature_pairs.h"
#include "deform/leaf_boxes.h"
#include "deform/triangle_pairs.h"
#include "tree/traverse_overlaps.h"
#include "volume/moving_box.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace abut {

/// Turns a pair of overlapping leaves into candidate feature pairs. A feature's box lies within
/// that of the triangle that represents it, so two leaves without a pair of overlapping triangles
/// have no candidates. Beyond that, candidates do not depend on which triangles overlap.
template <typename Sink>
class RepresentativePairs final : public OverlapVisitor {
public:
    RepresentativePairs(const LeafSource& a, const LeafSource& b, float margin,
                        FeaturePairs<Sink>& pairs)
        : a_(a), b_(b), margin_(margin), pairs_(pairs) {}

    /// Leaves out pairs of features that do not overlap until this time (see find_overlaps).
    void set_until(float until) { until_ = until; }
    /// Compares the boxes at one end of the step only.
    void set_at(StepEnd end) { at_ = end; }
    /// Another margin for the next visits.
    void set_margin(float margin) { margin_ = margin; }

    bool visit(std::uint32_t i, std::uint32_t j) override {
        const bool same = pairs_.is_self() && i == j;
        auto& [faces, edges, vertex_face, vertex_of_b] = overlaps_;
        const LeafRuns a = a_.runs(i), b = b_.runs(j);
        faces.a = a.faces, faces.b = b.faces;
        overlap(std::span(overlaps_).first(1));
        if (same)
            faces.keep_once();
        const std::uint32_t triangle_pairs = faces.count();
        triangle_pairs_ += triangle_pairs;
        if (triangle_pairs == 0)
            return true;

        edges.a = a.edges, edges.b = b.edges;
        vertex_face.a = a.vertices, vertex_face.b = b.faces;
        vertex_of_b.a = b.vertices, vertex_of_b.b = a.faces;
        overlap(std::span(overlaps_).subspan(1, same ? 2 : 3));
        if (same)
            edges.keep_once();
        edges.for_each([&](auto e, auto f) { pairs_.edges(e, f); });
        vertex_face.for_each([&](auto v, auto f) { pairs_.vertex_face(v, f); });
        if (!same)
            vertex_of_b.for_each([&](auto v, auto f) { pairs_.face_vertex(f, v); });
        return !pairs_.is_done();
    }
    /// The pairs of triangles whose boxes overlap, of all pairs of leaves so far.
    [[nodiscard]] std::uint64_t triangle_pairs() const { return triangle_pairs_; }

private:
    void overlap(std::span<RunOverlaps> overlaps) const {
        if (at_)
            find_overlaps_at(overlaps, margin_, *at_);
        else
            find_overlaps(overlaps, margin_, until_);
    }

    LeafBoxes a_, b_;
    float margin_;
    float until_ = 1;
    std::optional<StepEnd> at_;
    FeaturePairs<Sink>& pairs_;
    std::uint64_t triangle_pairs_ = 0;
    std::array<RunOverlaps, 4> overlaps_;
};

/// Visits the triangle pairs of overlapping leaves.
class LeafTrianglePairs final : public OverlapVisitor {
public:
    LeafTrianglePairs(const LeafFeatures& a, const LeafFeatures& b, float margin,
                      TrianglePairVisitor& visitor)
        : a_(a), b_(b), margin_(margin), visitor_(visitor) {}

    bool visit(std::uint32_t i, std::uint32_t j) override {
        RunOverlaps faces{a_.faces.run(i), b_.faces.run(j), {}};
        find_overlaps({&faces, 1}, margin_);
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
