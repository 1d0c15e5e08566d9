#pragma once

#include "math/vector.h"
#include "tree/tree.h"
#include "volume/volume_block.h"

#include <span>
#include <vector>

namespace abut {

/// A volume for every child of every node of a tree, in the tree's frame: what a traversal looks at
/// in place of the boxes.
template <typename V>
struct VolumeLayer {
    std::vector<VolumeBlock<V>> children; ///< children[n] belongs to the tree's nodes[n]
    V root;                               ///< around everything
    double reach = 0;                     ///< no point of a volume is farther from the origin

    VolumeLayer() = default;
    /// In          triangles: of the primitives, in the tree's frame. What double precision loses
    ///             on the way there is in the frame of a pair (traverse_volumes.h).
    /// Cost        every level fits its volumes to all triangles anew; nodes in parallel.
    VolumeLayer(const Tree& tree, std::span<const Triangle> triangles);

    [[nodiscard]] std::size_t bytes() const { return children.size() * sizeof(children[0]); }
};

} // namespace abut
