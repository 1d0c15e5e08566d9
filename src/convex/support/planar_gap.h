#pragma once

#include "convex/support/support_pair.h"

#include <optional>

namespace abut {

/// The least coordinate of the farthest point of a difference, over the unit vectors of a plane.
struct PlanarGap {
    Vec3 outward;           ///< the unit vector
    double value = 0;       ///< an upper bound: that of the unit vector
    double at_least = 0;    ///< no unit vector of the plane has less, but for rounding
    SupportSimplex nearest; ///< holds the point `value` times the unit vector, nearly
};

/// Two solids of revolution with parallel axes, in a frame of their own: both axes are along z, and b
/// is displaced along x and z. Their difference is a solid of revolution that has moved along x, so
/// its distance and its depth are those in the plane of both axes, whatever a search in space would
/// see: around a common axis, all directions would be as good.
struct ParallelAxes {
    SupportShape a, b;
    Vec3 origin;  ///< of the frame, relative to a's centre
    Vec3 x, y, z; ///< its axes in the world

    [[nodiscard]] Vec3 to_world(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// The frame, if both shapes are solids of revolution whose axes are parallel to a few roundings.
std::optional<ParallelAxes> parallel_axes(const SupportShape& a, const SupportShape& b);

/// Finds the distance or the depth in the plane of x and z.
///
/// In          the search may end once the value is less than `low`, or at_least more than `high`.
/// Accuracy    both bounds agree to a few roundings, unless the work is too large.
/// Source      expanding polygon, as [van den Bergen 2001] in the plane. Differs: it takes apart and
///             overlapping shapes alike, since each arc of directions has a lower bound of either
///             sign.
PlanarGap planar_gap(const SupportPair& pair, double low, double high);

} // namespace abut
