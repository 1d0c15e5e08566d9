#pragma once

#include "math/transform.h"
#include "tree/traverse_pair.h"
#include "tree/volume_tree.h"
#include "volume/relative_pose.h"

#include <cstdint>

namespace abut {

/// Two volume trees under their transforms: what a traversal of the pair needs to know.
struct VolumeFrame {
    RelativePose a_from_b, b_from_a;
    /// A squared distance in the tree's frame is at least, and at most, so many times larger in the
    /// world.
    float stretch_a_sq = 0, stretch_b_sq = 0;
    float most_stretch_a_sq = 0, most_stretch_b_sq = 0;
    bool valid = false; ///< false: of different kinds, singular, or of a size that single precision
                        ///< cannot square; the trees' boxes then have to do
};

/// In          world_from_a, world_from_b: of the trees' frames.
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

/// As the traversals of boxes, with the volumes in their place.
///
/// In          frame.valid; each volume tree built over the tree beside it.
/// Accuracy    conservative: every pair of triangles within the bound is visited.
/// Source      [Gottschalk, Lin, Manocha 1996], [Larsen et al. 1999]. Differs: one volume against
///             eight; of two nodes that of the larger circumscribed ball is opened.
Verdict traverse_contacts(const VolumeTraversal& traversal, LeafPairVisitor& visitor);
Verdict traverse_within(const VolumeTraversal& traversal, LeafPairVisitor& visitor);
Verdict traverse_nearest(const VolumeTraversal& traversal, LeafPairVisitor& visitor);

} // namespace abut
