#pragma once

#include "deform/elementary_stages.h"
#include "deform/feature_pairs.h"
#include "tree/traverse_overlaps.h"
#include "volume/moving_box.h"

#include <array>
#include <bit>
#include <cstdint>

namespace abut {

/// Two leaves' features that both represent and whose boxes overlap, as candidates.
template <typename Sink>
class RepresentativePairs final : public OverlapVisitor {
public:
    RepresentativePairs(const LeafFeatures& a, const LeafFeatures& b, float margin,
                        FeaturePairs<Sink>& pairs)
        : a_(a), b_(b), margin_(margin), pairs_(pairs) {}

    [[nodiscard]] std::uint64_t triangle_pairs() const { return triangle_pairs_; }

    bool visit(NodeRef leaf_a, NodeRef leaf_b) override {
        const std::uint32_t i = leaf_number(leaf_a), j = leaf_number(leaf_b);
        const bool same = pairs_.is_self() && i == j;
        overlaps_[0].a = a_.faces.boxes(i), overlaps_[0].b = b_.faces.boxes(j);
        overlaps_[1].a = a_.edges.boxes(i), overlaps_[1].b = b_.edges.boxes(j);
        overlaps_[2].a = a_.vertices.boxes(i), overlaps_[2].b = b_.faces.boxes(j);
        overlaps_[3].a = a_.faces.boxes(i), overlaps_[3].b = b_.vertices.boxes(j);
        find_overlaps(std::span(overlaps_).first(same ? 3 : 4), margin_);
        if (same) {
            keep_once(overlaps_[0]);
            keep_once(overlaps_[1]);
        }
        for (std::uint32_t k = 0; k < overlaps_[0].a.count; ++k)
            triangle_pairs_ += static_cast<unsigned>(std::popcount(overlaps_[0].masks[k]));
        const std::uint32_t *faces_a = a_.faces.ids(i), *faces_b = b_.faces.ids(j);
        const std::uint32_t *edges_a = a_.edges.ids(i), *edges_b = b_.edges.ids(j);
        for_each(overlaps_[1],
                 [&](std::size_t k, std::size_t m) { pairs_.edges(edges_a[k], edges_b[m]); });
        for_each(overlaps_[2], [&](std::size_t k, std::size_t m) {
            pairs_.vertex_face(a_.vertices.ids(i)[k], faces_b[m]);
        });
        if (!same)
            for_each(overlaps_[3], [&](std::size_t k, std::size_t m) {
                pairs_.face_vertex(faces_a[k], b_.vertices.ids(j)[m]);
            });
        return true;
    }

private:
    /// Leaves each pair of a run with itself once.
    static void keep_once(RunOverlaps& overlaps) {
        for (std::uint32_t k = 0; k < overlaps.a.count; ++k)
            overlaps.masks[k] &= ~0U << k << 1;
    }
    template <typename Visit>
    static void for_each(const RunOverlaps& overlaps, const Visit& visit) {
        for (std::uint32_t k = 0; k < overlaps.a.count; ++k)
            for_each_bit(overlaps.masks[k], [&](std::size_t i) { visit(k, i); });
    }

    const LeafFeatures& a_;
    const LeafFeatures& b_;
    float margin_;
    FeaturePairs<Sink>& pairs_;
    std::uint64_t triangle_pairs_ = 0;
    std::array<RunOverlaps, 4> overlaps_;
};

} // namespace abut
