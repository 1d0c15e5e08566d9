#pragma once

#include "volume/kdop.h"
#include "volume/obb.h"
#include "volume/sphere.h"
#include "volume/ssv.h"
#include "volume/swept_sphere.h"
#include "volume/volume_batch.h"

namespace abut {

/// Bounds of the distances between one volume and eight, in the frame of the eight.
struct VolumeBounds {
    static constexpr std::size_t kLanes = 8;
    alignas(32) float lower_sq[kLanes]; ///< lower bound of the squared distance; 0: may overlap
    alignas(32) float gap[kLanes];      ///< the widest gap along a direction; negative: overlap
    alignas(32) float upper_sq[kLanes]; ///< upper bound of the squared distance of any two points
};

/// Bounds the distances between the volume `one`, given in the frame of the batch, and all volumes
/// of the batch.
///
/// Degenerate  a lane that was never set holds a volume that is a point at the origin.
/// Accuracy    conservative: the image's margin is subtracted from every gap. For rectangles and
///             segments the gap is their distance up to rounding. For boxes it is the widest gap
///             along the 15 axes, or three orthogonal gaps together.
/// Cost        one SIMD pass: about 20 operations (sphere), 100 (LSS), 250 (OBB), 900 (RSS) for
///             eight pairs. SSV: as the two kinds that are compared; a segment and rectangles take
///             a third of RSS, a point and rectangles a twentieth.
/// Source      OBB: [Gottschalk, Lin, Manocha 1996], swept spheres: [Larsen et al. 1999]. Differs:
///             no branches; the closest points only propose a direction, and the gap along it is
///             the result, so their rounding needs no bound.
template <typename V>
void bound_distances(const VolumeBatch<V>& batch, const typename V::Image& one,
                     VolumeBounds& bounds);

/// As bound_distances, but with one lane: the reference for every SIMD target.
template <typename V>
void bound_distances_reference(const VolumeBatch<V>& batch, const typename V::Image& one,
                               VolumeBounds& bounds);

/// Lower bound of the distance of two volumes, in a's frame. `map` takes b's frame to a's.
template <typename V>
float distance_lower_bound(const V& a, const V& b, const typename V::Map& map);

} // namespace abut
