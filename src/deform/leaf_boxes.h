#pragma once

#include "deform/deformable_data.h"
#include "deform/leaf_features.h"
#include "volume/moving_box.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace abut {

/// The faces of a leaf, and the edges and vertices that they represent.
struct LeafRuns {
    MovingBoxRun faces, edges, vertices;
};

/// The boxes of a leaf: the runs of its faces, edges and vertices one after another.
struct FittedLeaf {
    static constexpr std::size_t kMostFaces = TriangleLeaf::kLanes;
    static constexpr std::size_t kMostFeatures = 7 * kMostFaces; ///< 3 edges, 3 vertices of each
    std::uint32_t leaf;
    std::array<float, MovingBoxRun::kRows * kMostFeatures + MovingBoxRun::kPadding> rows;
};

/// Gives access to the leaves of a hierarchy: to their stored boxes or, if it stores none, to the
/// positions from which they are fitted. The tasks of a search share it, and take over each other's
/// fitted leaves.
class LeafSource {
public:
    using Fitted = std::unique_ptr<FittedLeaf[]>;

    /// In: both arguments must outlive this.
    LeafSource(const DeformableData& surface, const SweptTree& swept)
        : surface_(surface), swept_(swept) {}

    [[nodiscard]] const DeformableData& surface() const { return surface_; }
    [[nodiscard]] const SweptTree& swept() const { return swept_; }
    /// Null if the hierarchy has boxes.
    [[nodiscard]] Fitted take() const;
    void give_back(Fitted fitted) const;

private:
    const DeformableData& surface_;
    const SweptTree& swept_;
    mutable std::mutex mutex_;
    mutable std::vector<Fitted> idle_;
};

/// Gives the features of one leaf after another, with their boxes. If the hierarchy keeps no boxes,
/// they are fitted here. Those of recent leaves are kept, because a traversal comes back to a leaf
/// soon.
class LeafBoxes {
public:
    /// In: source, which must outlive this.
    explicit LeafBoxes(const LeafSource& source) : source_(source), fitted_(source.take()) {}
    ~LeafBoxes() { source_.give_back(std::move(fitted_)); }
    LeafBoxes(const LeafBoxes&) = delete;
    LeafBoxes& operator=(const LeafBoxes&) = delete;

    /// The runs are valid until the next call.
    LeafRuns runs(std::uint32_t leaf) {
        const LeafFeatures& leaves = source_.swept().leaves;
        return fitted_ ? fitted_runs(leaf)
                       : LeafRuns{leaves.faces.run(leaf), leaves.edges.run(leaf),
                                  leaves.vertices.run(leaf)};
    }

private:
    LeafRuns fitted_runs(std::uint32_t leaf);
    void fit(std::uint32_t leaf, FittedLeaf& fitted) const;

    const LeafSource& source_;
    LeafSource::Fitted fitted_;
};

/// The box of a leaf's triangles at one end of the step, from the vertices' boxes there.
Aabb box_of_leaf(const LeafFeatures& leaves, std::uint32_t leaf, const SurfaceView& surface,
                 std::span<const Aabb> vertex_boxes);

} // namespace abut
