#pragma once

#include "deform/elementary_stages.h"
#include "deform/feature_pairs.h"
#include "tree/traverse_overlaps.h"
#include "volume/box_run.h"

#include <array>
#include <bit>
#include <cstdint>

namespace abut {

/// The overlaps of two leaves' boxes, of one kind of feature each.
class RunOverlaps {
public:
    RunOverlaps(const FeatureRuns& a, std::uint32_t leaf_a, const FeatureRuns& b,
                std::uint32_t leaf_b, float margin)
        : a_(a), b_(b), begin_a_(a.begin(leaf_a)), begin_b_(b.begin(leaf_b)),
          count_(a.count(leaf_a)) {
        overlap_masks(a.boxes(leaf_a), b.boxes(leaf_b), margin, masks_);
    }

    /// Leaves each pair of a run with itself once.
    void keep_once() {
        for (std::uint32_t k = 0; k < count_; ++k)
            masks_[k] &= ~0U << k << 1;
    }
    [[nodiscard]] std::uint32_t count() const {
        std::uint32_t pairs = 0;
        for (std::uint32_t k = 0; k < count_; ++k)
            pairs += static_cast<std::uint32_t>(std::popcount(masks_[k]));
        return pairs;
    }
    /// Calls visit(id of a, id of b).
    template <typename Visit>
    void for_each(const Visit& visit) const {
        for (std::uint32_t k = 0; k < count_; ++k)
            for_each_bit(masks_[k], [&](std::size_t i) {
                visit(a_.id(begin_a_ + k), b_.id(begin_b_ + static_cast<std::uint32_t>(i)));
            });
    }

private:
    const FeatureRuns& a_;
    const FeatureRuns& b_;
    std::uint32_t begin_a_, begin_b_, count_;
    std::array<std::uint32_t, BoxRun::kMost> masks_;
};

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
        RunOverlaps faces(a_.faces, i, b_.faces, j, margin_);
        if (same)
            faces.keep_once();
        // A feature's box lies in that of the triangle that represents it.
        const std::uint32_t count = faces.count();
        if (count == 0)
            return true;
        triangle_pairs_ += count;

        RunOverlaps edges(a_.edges, i, b_.edges, j, margin_);
        if (same)
            edges.keep_once();
        edges.for_each([&](std::uint32_t e, std::uint32_t f) { pairs_.edges(e, f); });
        RunOverlaps(a_.vertices, i, b_.faces, j, margin_)
            .for_each([&](std::uint32_t v, std::uint32_t f) { pairs_.vertex_face(v, f); });
        if (!same)
            RunOverlaps(a_.faces, i, b_.vertices, j, margin_)
                .for_each([&](std::uint32_t f, std::uint32_t v) { pairs_.face_vertex(f, v); });
        return true;
    }

private:
    const LeafFeatures& a_;
    const LeafFeatures& b_;
    float margin_;
    FeaturePairs<Sink>& pairs_;
    std::uint64_t triangle_pairs_ = 0;
};

} // namespace abut
