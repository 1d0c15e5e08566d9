#pragma once

#include <abut/volume.h>

#include "tree/volume_layer.h"
#include "volume/kdop.h"
#include "volume/obb.h"
#include "volume/sphere.h"

#include <memory>
#include <variant>

namespace abut {

/// The volumes of one kind over one tree. Immutable once built.
class VolumeTree {
public:
    using Layer = std::variant<VolumeLayer<BoundingSphere>, VolumeLayer<Pss>, VolumeLayer<Lss>,
                               VolumeLayer<Rss>, VolumeLayer<Obb>, VolumeLayer<Kdop14>,
                               VolumeLayer<Kdop18>, VolumeLayer<Kdop26>>;

    VolumeTree(Volume kind, Layer layer) : kind_(kind), layer_(std::move(layer)) {}

    [[nodiscard]] Volume kind() const { return kind_; }
    [[nodiscard]] const Layer& layer() const { return layer_; }
    /// No point of a volume is farther from the origin of the tree's frame.
    [[nodiscard]] double reach() const;
    [[nodiscard]] std::size_t bytes() const;

private:
    Volume kind_;
    Layer layer_;
};

/// Fits volumes to all that lies below the children of a tree of triangles.
///
/// Returns     none for the kinds that the tree's own boxes are: `automatic` and `aabb`; and for an
///             empty tree.
std::unique_ptr<const VolumeTree> build_volume_tree(Volume kind, const Tree& tree,
                                                    const TreeMesh& mesh);

} // namespace abut
