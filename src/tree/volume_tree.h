#pragma once

#include <abut/volume.h>

#include "tree/volume_layer.h"
#include "volume/kdop.h"
#include "volume/obb.h"
#include "volume/sphere.h"
#include "volume/ssv.h"

#include <memory>
#include <variant>

namespace abut {

/// Volumes of one kind for all children of one tree. Immutable once built.
class VolumeTree {
public:
    using Layer = std::variant<VolumeLayer<BoundingSphere>, VolumeLayer<Pss>, VolumeLayer<Lss>,
                               VolumeLayer<Rss>, VolumeLayer<Ssv>, VolumeLayer<Obb>,
                               VolumeLayer<Kdop14>, VolumeLayer<Kdop18>, VolumeLayer<Kdop26>>;

    VolumeTree(Volume kind, Layer layer) : kind_(kind), layer_(std::move(layer)) {}

    [[nodiscard]] Volume kind() const { return kind_; }
    [[nodiscard]] const Layer& layer() const { return layer_; }
    /// Upper bound of the distance of a volume's points from the origin of the tree's frame.
    [[nodiscard]] double reach() const;
    [[nodiscard]] std::size_t bytes() const;

private:
    Volume kind_;
    Layer layer_;
};

/// Fits volumes to all that lies below each child of a tree of triangles.
///
/// Returns     null for an empty tree, and for `automatic` and `aabb`: the tree's own boxes serve
///             these.
std::unique_ptr<const VolumeTree> build_volume_tree(Volume kind, const Tree& tree,
                                                    const TreeMesh& mesh);

} // namespace abut
