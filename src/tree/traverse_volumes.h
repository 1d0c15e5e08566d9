#pragma once

#include "math/transform.h"
#include "tree/traverse_pair.h"
#include "tree/volume_tree.h"
#include "volume/relative_pose.h"

#include <cstdint>

namespace abut {

/// The frames of two volume trees under their transforms, as a traversal of the pair needs them.
struct VolumeFrame {
    RelativePose a_from_b, b_from_a;
    /// The world's squared distance is at least stretch_sq, and at most most_stretch_sq, times that
    /// in the tree's frame.
    float stretch_a_sq = 0, stretch_b_sq = 0;
    float most_stretch_a_sq = 0, most_stretch_b_sq = 0;
    /// False if the kinds cannot be compared, a transform is singular, or single precision cannot
    /// square the sizes. The trees' boxes are then used instead.
    bool valid = false;
};

/// Computes the frames of a pair of volume trees.
/// In          world_from_a, world_from_b: transforms of the trees' frames.
/// Accuracy    the margins cover all rounding: of composing the transforms, of the world positions
///             that the exact kernels see, and of the traversal's single precision.
VolumeFrame make_volume_frame(const VolumeTree& a, const Transform& world_from_a,
                              const VolumeTree& b, const Transform& world_from_b);

struct VolumeTraversal {
    PairTraversal& pair; ///< the trees, the bound, the counters
    const VolumeTree& volumes_a;
    const VolumeTree& volumes_b;
    const VolumeFrame& frame;
};

/// The traversals of traverse_pair.h, with these volumes in place of boxes.
///
/// In          frame.valid; each volume tree was built over its tree.
/// Accuracy    conservative: every pair of triangles within the bound is visited.
/// Source      [Gottschalk, Lin, Manocha 1996], [Larsen et al. 1999]. Differs: tests one volume
///             against eight; of two nodes, opens the one whose circumscribed ball is larger.
Verdict traverse_contacts(const VolumeTraversal& traversal, LeafPairVisitor& visitor);
Verdict traverse_within(const VolumeTraversal& traversal, LeafPairVisitor& visitor);
Verdict traverse_nearest(const VolumeTraversal& traversal, LeafPairVisitor& visitor);

} // namespace abut
