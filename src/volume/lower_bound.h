#pragma once

#include "volume/kdop.h"
#include "volume/obb.h"
#include "volume/sphere.h"
#include "volume/swept_sphere.h"
#include "volume/volume_block.h"

namespace abut {

/// What is known of the distance of one volume to eight, in the frame of the eight.
struct VolumeBounds {
    static constexpr std::size_t kLanes = 8;
    alignas(32) float lower_sq[kLanes]; ///< no two points are nearer, squared; 0: may overlap
    alignas(32) float gap[kLanes];      ///< widest gap along a direction; negative: overlap
    alignas(32) float upper_sq[kLanes]; ///< no two points are farther apart, squared
};

/// The volume `one`, seen in the frame of the block, against all volumes of the block.
///
/// Degenerate  lanes that were never set hold volumes that are a point at the origin.
/// Accuracy    certain: the image's margin is taken off every gap. The gap of rectangles and
///             segments is their distance to rounding; that of boxes the widest along the 15 axes,
///             or of three at right angles together.
/// Cost        one SIMD pass: some 20 operations (sphere), 100 (LSS), 250 (OBB), 900 (RSS) for
///             eight pairs.
/// Source      OBB: [Gottschalk, Lin, Manocha 1996], swept spheres: [Larsen et al. 1999]. Differs:
///             no branches; the closest points only propose a direction, and the gap along it
///             counts, so no rounding of theirs needs a bound.
template <typename V>
void bound_distances(const VolumeBlock<V>& block, const typename V::Image& one,
                     VolumeBounds& bounds);

/// The same with one lane: the reference for every SIMD target.
template <typename V>
void bound_distances_reference(const VolumeBlock<V>& block, const typename V::Image& one,
                               VolumeBounds& bounds);

/// Lower bound of the distance of two volumes, in a's frame; `map` takes b's frame to a's.
template <typename V>
float distance_lower_bound(const V& a, const V& b, const typename V::Map& map);

/// Whether two volumes may share a point. Certain if false.
template <typename V>
bool may_overlap(const V& a, const V& b, const typename V::Map& map);

} // namespace abut
