#pragma once

#include "geometry/point_triangle_distance.h"
#include "math/vector.h"

namespace abut {

/// Closest points of two segments, by their parameters.
struct SegmentPoints {
    double s = 0, t = 0, distance_sq = 0;
};

/// Closest points of the segments s u and r + t v, s and t in [0, 1].
///
/// Degenerate  zero-length segments act as points; parallel segments return one minimiser.
/// Source      [Ericson 2005, 5.1.9]. Differs: the lines' parameters come from cross products,
///             which keeps almost parallel segments exact to rounding.
SegmentPoints nearest_on_segments(const Vec3& u, const Vec3& v, const Vec3& r);

/// Closest points of the segments from p0 to p1 and from q0 to q1.
ClosestPoints segment_segment_distance(const Vec3& p0, const Vec3& p1, const Vec3& q0,
                                       const Vec3& q1);

/// Closest points of two triangles. If an edge of one pierces the other, both are the piercing
/// point and the distance is 0.
///
/// Degenerate  zero-area triangles act as segments or points.
/// Accuracy    a few roundings of the coordinates' differences.
ClosestPoints triangle_triangle_distance(const Triangle& a, const Triangle& b);

} // namespace abut
