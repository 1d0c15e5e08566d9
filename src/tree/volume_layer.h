#pragma once

#include "math/vector.h"
#include "tree/obb_tree.h"
#include "volume/volume_batch.h"

#include <span>
#include <vector>

namespace abut {

/// A volume for each child of each node of a tree, in the tree's frame. A traversal uses these in
/// place of the boxes.
template <typename V>
struct VolumeLayer {
    std::vector<VolumeBatch<V>> children; ///< children[n] belongs to the tree's nodes[n]
    V root;                               ///< encloses everything
    double reach = 0;                     ///< upper bound of a volume's distance from the origin

    VolumeLayer() = default;
    /// In          triangles: the tree's primitives, in the tree's frame. The pair's frame
    ///             (traverse_volumes.h) accounts for the rounding of positions to double precision.
    /// Cost        every level fits its volumes to all triangles anew; nodes in parallel.
    VolumeLayer(const Tree& tree, std::span<const Triangle> triangles);

    [[nodiscard]] std::size_t bytes() const { return children.size() * sizeof(children[0]); }
};

} // namespace abut
