#pragma once

#include "convex/support/support_shape.h"

#include <cstdint>

namespace abut {

/// The signed distance of two shapes, in the world.
struct SupportGap {
    double distance = 0; ///< negative: minus the depth
    Vec3 point_a, point_b;
    Vec3 normal; ///< unit vector from a to b: moving b by the depth along it separates the shapes
    /// False if the search for a depth ended before its bounds agreed: the distance is then minus
    /// the lower bound of the depth.
    bool bounds_agree = true;
};

/// What support_gap is to return for shapes that meet.
enum class SupportDepths : std::uint8_t {
    no,  ///< 0, a common point and no normal suffice if the cores meet
    yes, ///< minus the depth
};

/// Measures the gap between two shapes.
///
/// In/out      upper_bound: if the gap is larger, any distance above it may be returned. direction:
///             a guess of the direction from a to b, or zero; replaced by the one that was found.
/// Accuracy    a few roundings of the coordinates' differences; a depth to kDepthTolerance.
/// Source      support_distance, support_depth.
SupportGap support_gap(const SupportShape& a, const SupportShape& b, double upper_bound,
                       SupportDepths depths, Vec3& direction);

/// Whether two shapes share a point, to rounding. `direction` as above.
bool supports_meet(const SupportShape& a, const SupportShape& b, Vec3& direction);

/// A lower bound of the gap between two shapes along a unit vector from a to b. Rounding is taken
/// off. Negative: the planes across the vector do not separate the shapes.
double separation_along(const SupportShape& a, const SupportShape& b, const Vec3& normal);

} // namespace abut
