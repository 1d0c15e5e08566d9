#pragma once

#include "deform/feature_pairs.h"
#include "deform/leaf_features.h"
#include "deform/triangle_pairs.h"
#include "tree/traverse_overlaps.h"
#include "volume/moving_box.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace abut {

/// Turns a pair of overlapping leaves into candidate feature pairs. A feature's box lies within
/// that of the triangle that represents it, so the triangle pairs themselves need no test. They are
/// found only to be counted.
template <typename Sink>
class RepresentativePairs final : public OverlapVisitor {
public:
    /// In: a counter of triangle pairs, or null.
    RepresentativePairs(const LeafFeatures& a, const LeafFeatures& b, float margin,
                        FeaturePairs<Sink>& pairs, std::uint64_t* triangle_pairs)
        : a_(a), b_(b), margin_(margin), pairs_(pairs), triangle_pairs_(triangle_pairs) {}

    /// Leaves out pairs of features that do not overlap until this time (see find_overlaps).
    void set_until(float until) { until_ = until; }

    bool visit(std::uint32_t i, std::uint32_t j) override {
        const bool same = pairs_.is_self() && i == j;
        auto& [faces, edges, vertex_face, vertex_of_b] = overlaps_;
        faces.a = a_.faces.run(i), faces.b = b_.faces.run(j);
        edges.a = a_.edges.run(i), edges.b = b_.edges.run(j);
        vertex_face.a = a_.vertices.run(i), vertex_face.b = faces.b;
        vertex_of_b.a = b_.vertices.run(j), vertex_of_b.b = faces.a;
        const std::size_t first = triangle_pairs_ != nullptr ? 0 : 1, last = same ? 3 : 4;
        find_overlaps(std::span(overlaps_).subspan(first, last - first), margin_, until_);
        if (same)
            faces.keep_once(), edges.keep_once();

        if (triangle_pairs_ != nullptr)
            *triangle_pairs_ += faces.count();
        edges.for_each([&](auto e, auto f) { pairs_.edges(e, f); });
        vertex_face.for_each([&](auto v, auto f) { pairs_.vertex_face(v, f); });
        if (!same)
            vertex_of_b.for_each([&](auto v, auto f) { pairs_.face_vertex(f, v); });
        return !pairs_.is_done();
    }

private:
    const LeafFeatures& a_;
    const LeafFeatures& b_;
    float margin_;
    float until_ = 1;
    FeaturePairs<Sink>& pairs_;
    std::uint64_t* triangle_pairs_;
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
