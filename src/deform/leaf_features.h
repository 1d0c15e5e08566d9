#pragma once

#include "mesh/representatives.h"
#include "tree/tree.h"
#include "volume/box_run.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Leaves are numbered in the order of their slots.
inline std::uint32_t leaf_number(NodeRef leaf) {
    return leaf.first() / TriangleLeaf::kLanes;
}

/// Features of one kind, leaf by leaf, and boxes of them.
class FeatureRuns {
public:
    void add(std::uint32_t id) { ids_.push_back(id); }
    /// What was added since the last end belongs to the next leaf.
    void end_leaf() { begin_.push_back(static_cast<std::uint32_t>(ids_.size())); }
    void allocate_boxes() { rows_.assign(BoxRun::kRows * ids_.size() + BoxRun::kPadding, 0.0F); }

    [[nodiscard]] std::uint32_t begin(std::uint32_t leaf) const { return begin_[leaf]; }
    [[nodiscard]] std::uint32_t count(std::uint32_t leaf) const {
        return begin_[leaf + 1] - begin_[leaf];
    }
    /// By its place among the features of all leaves.
    [[nodiscard]] std::uint32_t id(std::uint32_t place) const { return ids_[place]; }
    [[nodiscard]] BoxRun boxes(std::uint32_t leaf) const {
        return {rows_.data() + BoxRun::kRows * begin_[leaf], count(leaf)};
    }
    void set_box(std::uint32_t leaf, std::uint32_t k, const Aabb& box) {
        float* row = rows_.data() + BoxRun::kRows * begin_[leaf] + k;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            row[axis * count(leaf)] = box.lower[axis];
            row[(axis + 3) * count(leaf)] = box.upper[axis];
        }
    }
    [[nodiscard]] std::size_t size() const { return ids_.size(); }
    [[nodiscard]] std::size_t bytes() const {
        return begin_.size() * sizeof(begin_[0]) + ids_.size() * sizeof(ids_[0]) +
               rows_.size() * sizeof(rows_[0]);
    }

private:
    std::vector<std::uint32_t> begin_{0}; ///< leaf -> place of its first feature
    std::vector<std::uint32_t> ids_;
    std::vector<float> rows_; ///< a BoxRun for each leaf
};

/// The triangles of each leaf, and the edges and vertices that they represent.
struct LeafFeatures {
    FeatureRuns faces, edges, vertices;

    LeafFeatures() = default;
    LeafFeatures(const Tree& tree, const SurfaceView& surface,
                 std::span<const Represented> represented);

    [[nodiscard]] std::size_t bytes() const {
        return faces.bytes() + edges.bytes() + vertices.bytes();
    }
};

/// Sets the boxes of a leaf's features to those of their vertices; returns that of its triangles.
Aabb fit_leaf(LeafFeatures& leaves, std::uint32_t leaf, const SurfaceView& surface,
              std::span<const Aabb> vertex_boxes);

} // namespace abut
