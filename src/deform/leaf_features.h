#pragma once

#include "mesh/representative_triangles.h"
#include "tree/moving_tree.h"
#include "tree/obb_tree.h"
#include "volume/moving_box.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

static_assert(3 * TriangleLeaf::kLanes <= MovingBoxRun::kMost, "a leaf's edges are one run");

/// Features of one kind and their boxes, leaf by leaf.
class FeatureRuns {
public:
    void reserve(std::size_t leaves, std::size_t features) {
        begin_.reserve(leaves + 1);
        ids_.reserve(features);
    }
    void add(std::uint32_t id) { ids_.push_back(id); }
    /// Ends a leaf: the features added since the previous call belong to it.
    void end_leaf() { begin_.push_back(static_cast<std::uint32_t>(ids_.size())); }
    /// Without this, the features have no boxes.
    void allocate_boxes() {
        rows_.assign(MovingBoxRun::kRows * ids_.size() + MovingBoxRun::kPadding, 0.0F);
    }

    [[nodiscard]] bool has_boxes() const { return !rows_.empty(); }
    [[nodiscard]] std::size_t leaves() const { return begin_.size() - 1; }
    [[nodiscard]] std::uint32_t count(std::uint32_t leaf) const {
        return begin_[leaf + 1] - begin_[leaf];
    }
    [[nodiscard]] const std::uint32_t* ids(std::uint32_t leaf) const {
        return ids_.data() + begin_[leaf];
    }
    /// The features of the leaves from `first` on, before `last`.
    [[nodiscard]] std::span<const std::uint32_t> ids(std::uint32_t first,
                                                     std::uint32_t last) const {
        return std::span(ids_).subspan(begin_[first], begin_[last] - begin_[first]);
    }
    [[nodiscard]] MovingBoxRun run(std::uint32_t leaf) const {
        return {rows_.data() + MovingBoxRun::kRows * begin_[leaf], ids(leaf), count(leaf)};
    }
    void set_box(std::uint32_t leaf, std::uint32_t k, StepEnd end, const Aabb& box) {
        float* rows = rows_.data() + MovingBoxRun::kRows * begin_[leaf];
        set_bounds(rows + first_bound(end, count(leaf), k), count(leaf), box);
    }
    /// Makes the boxes at the end those at the start.
    void start_at_end(std::uint32_t leaf) {
        float* rows = rows_.data() + MovingBoxRun::kRows * begin_[leaf];
        std::copy(rows + MovingBoxRun::kEnd * count(leaf), rows + MovingBoxRun::kRows * count(leaf),
                  rows);
    }
    [[nodiscard]] MovingBox box(std::uint32_t leaf, std::uint32_t k) const {
        const float* rows = rows_.data() + MovingBoxRun::kRows * begin_[leaf];
        const auto at = [&](StepEnd end) {
            return bounds_from(rows + first_bound(end, count(leaf), k), count(leaf));
        };
        return {at(StepEnd::start), at(StepEnd::end)};
    }
    [[nodiscard]] std::size_t bytes() const {
        return begin_.size() * sizeof(begin_[0]) + ids_.size() * sizeof(ids_[0]) +
               rows_.size() * sizeof(rows_[0]);
    }

private:
    std::vector<std::uint32_t> begin_{0}; ///< index of each leaf's first feature
    std::vector<std::uint32_t> ids_;
    std::vector<float> rows_; ///< a MovingBoxRun for each leaf
};

/// The triangles of each leaf, and the edges and vertices that they represent.
struct LeafFeatures {
    FeatureRuns faces, edges, vertices;

    LeafFeatures() = default;
    /// Lists the features. Their boxes are not allocated yet.
    LeafFeatures(const Tree& tree, const SurfaceView& surface,
                 std::span<const Represented> represented);

    void allocate_boxes();
    [[nodiscard]] bool has_boxes() const { return faces.has_boxes(); }
    [[nodiscard]] std::size_t bytes() const {
        return faces.bytes() + edges.bytes() + vertices.bytes();
    }
};

/// The leaves of a tree, in the order of their numbers.
std::vector<NodeRef> leaves_of(const Tree& tree);

/// The box of some vertices.
template <std::size_t n>
Aabb box_of(const std::array<std::uint32_t, n>& vertices, std::span<const Aabb> vertex_boxes) {
    Aabb box = vertex_boxes[vertices[0]];
    for (std::size_t i = 1; i < n; ++i)
        box.merge(vertex_boxes[vertices[i]]);
    return box;
}

/// Gives each feature of a leaf the box that `box_of(id)` returns, at one end of the step. Returns
/// the box of all of them.
template <typename BoxOf>
Aabb fit_run(FeatureRuns& runs, std::uint32_t leaf, StepEnd end, const BoxOf& box_of) {
    Aabb all;
    for (std::uint32_t k = 0; k < runs.count(leaf); ++k) {
        const Aabb box = box_of(runs.ids(leaf)[k]);
        runs.set_box(leaf, k, end, box);
        all.merge(box);
    }
    return all;
}

/// Sets the boxes of a leaf's features at one end of the step from those of their vertices there.
/// Returns the box of the leaf's triangles.
Aabb fit_leaf(LeafFeatures& leaves, std::uint32_t leaf, StepEnd end, const SurfaceView& surface,
              std::span<const Aabb> vertex_boxes);

} // namespace abut
