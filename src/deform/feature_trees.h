#pragma once

#include "deform/leaf_features.h"
#include "tree/traverse_overlaps.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace abut {

/// A hierarchy over features of one kind.
struct FeatureTree {
    MovingTree tree;
    FeatureRuns runs;

    [[nodiscard]] std::size_t bytes() const { return tree.bytes() + runs.bytes(); }
};

/// Hierarchies over a surface's faces, edges and vertices. They need no representative triangles,
/// but three times the memory.
struct FeatureTrees {
    FeatureTree faces, edges, vertices;

    /// Builds the hierarchies from the vertices' swept boxes. Call fit() for both ends before use.
    FeatureTrees(const SurfaceView& surface, std::span<const Aabb> vertex_boxes);
    /// Sets the boxes at one end of the step from those of the vertices there.
    void fit(const SurfaceView& surface, StepEnd end, std::span<const Aabb> vertex_boxes);

    [[nodiscard]] std::size_t bytes() const {
        return faces.bytes() + edges.bytes() + vertices.bytes();
    }
};

/// Visits the overlaps of features in the leaves of two hierarchies: calls visit(id of a, id of b)
/// once for each pair.
template <typename Visit>
class FeatureLeafPairs final : public OverlapVisitor {
public:
    FeatureLeafPairs(const FeatureTree& a, const FeatureTree& b, float margin, const Visit& visit)
        : a_(a), b_(b), margin_(margin), visit_(visit) {}

    bool visit(std::uint32_t i, std::uint32_t j) override {
        RunOverlaps overlaps{a_.runs.run(i), b_.runs.run(j), {}};
        find_overlaps({&overlaps, 1}, margin_);
        if (&a_ == &b_ && i == j)
            overlaps.keep_once();
        bool more = true;
        overlaps.for_each([&](auto a, auto b) { more = more && visit_(a, b); });
        return more;
    }

private:
    const FeatureTree& a_;
    const FeatureTree& b_;
    float margin_;
    const Visit& visit_;
};

} // namespace abut
