#pragma once

#include "convex/support/support_shape.h"

#include <cstdint>

namespace abut {

/// The signed distance of two shapes, in the world.
struct SupportGap {
    double distance = 0;   ///< 0: they touch, to rounding; negative: minus the depth
    Vec3 point_a, point_b; ///< b minus a is `distance` times the normal
    Vec3 normal; ///< unit vector from a to b: moving b by the depth along it separates the shapes
    /// False if the search ended before its bounds agreed. The depth is then that of SupportDepths.
    bool bounds_agree = true;
};

/// Shapes whose computed gap is at most this many roundings of their pair touch: their gap is 0.
inline constexpr double kTouchRoundings = 2;
/// A computed gap of more than this many roundings is proven.
inline constexpr double kCertainRoundings = 4;

/// What support_gap is to return for shapes that meet.
enum class SupportDepths : std::uint8_t {
    no,    ///< a distance of 0 or less, a common point and no normal suffice if the cores meet
    bound, ///< minus the depth, or minus a lower bound of it if its bounds do not agree
    yes, ///< minus the depth. If its bounds do not agree, a shorter motion may separate the shapes
};

/// Measures the gap between two shapes.
///
/// In/out      upper_bound: if the gap is larger, any distance above it may be returned, without
///             points. direction: a guess of the direction from a to b, or zero; replaced by the one
///             that was found. The guess only serves to prove that the gap is larger than the bound:
///             it has no influence on other results.
/// Out         the same, turned round, for the shapes in the other order.
/// Accuracy    a few roundings of the coordinates' differences; a depth to kDepthTolerance. The normal
///             as `refined` says.
/// Source      planar_gap for solids of revolution with parallel axes; else support_distance,
///             support_depth.
SupportGap support_gap(const SupportShape& a, const SupportShape& b, double upper_bound,
                       SupportDepths depths, Vec3& direction);

/// A point that two shapes share, to rounding. For shapes that are apart, a point between them.
Vec3 common_point(const SupportShape& a, const SupportShape& b);

/// A lower bound of the gap between two shapes along a unit vector from a to b. Rounding is taken
/// off. Negative: the planes across the vector do not separate the shapes.
double separation_along(const SupportShape& a, const SupportShape& b, const Vec3& normal);

} // namespace abut
