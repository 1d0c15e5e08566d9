#pragma once

#include <abut/types.h>

#include "math/vector.h"

#include <cmath>

namespace abut {

/// A distance above this share of the coordinates tells its direction to 2^-40: that tilts the planes
/// across it by no more than a search for a distance rounds.
inline constexpr double kTellsDirection = 0x1p-12;

/// Corrects the direction between the closest points of two convex solids.
///
/// The vector between points that nearly touch is rounded as much as the points, so its direction
/// may turn towards an edge or a face that it should be across. No point of a reaches beyond its
/// closest point along the true direction, nor does one of b against it. Where one does, the
/// direction is projected so that it does not [Kaczmarz 1937, for half-spaces].
///
/// In          way: from the closest point of a to that of b, not zero. rounding: a height that is
///             no more than rounding. beyond_a(n): the vector from a's closest point to a's farthest
///             point along n. beyond_b(n): from b's farthest point against n to b's closest point.
/// Out         a unit vector. It is the direction of `way` if that needs no correction.
/// Cost        one farthest point of each solid; up to 64 where corrections follow each other.
template <typename BeyondA, typename BeyondB>
Vec3 supporting_normal(const Vec3& way, double rounding, const BeyondA& beyond_a,
                       const BeyondB& beyond_b) {
    constexpr int kMostSteps = 64;
    const Vec3 start = normalized_or_zero(way);
    Vec3 normal = start, last;
    for (int step = 0; step < kMostSteps; ++step) {
        const Vec3 of_a = beyond_a(normal), of_b = beyond_b(normal);
        const bool is_of_a = dot(of_a, normal) > dot(of_b, normal);
        const Vec3& beyond = is_of_a ? of_a : of_b;
        const double height = dot(beyond, normal);
        if (!(height > rounding))
            return normal;
        Vec3 next = normalized_or_zero(normal - (height / length_sq(beyond)) * beyond);
        // Two edges, one of each solid, that are nearly parallel: across both at once.
        const Vec3 both = normalized_or_zero(cross(last, beyond));
        const double along = dot(both, normal);
        constexpr double kNearlyAcross = 1 - 0x1p-10; // 2.5 degrees
        if (step > 0 && std::abs(along) > kNearlyAcross)
            next = along < 0 ? -both : both;
        last = beyond, normal = next;
    }
    return dot(normal, start) > 0 ? normal : start;
}

} // namespace abut
