#pragma once

#include "convex/proof/integer_difference.h"
#include "convex/proof/placed_points.h"
#include "convex/search/gjk.h"

namespace abut {

/// The closest points of the convex hulls of two point sets, or a common point; every decision is
/// exact.
struct ExactClosestPoints {
    /// Corners of the difference, by numbers of points, whose hull holds the nearest point, with
    /// its positive weights.
    DifferenceSimplex simplex;
    bool meeting = false;
    double distance = 0; ///< 0 if, and only if, the hulls meet
    double at_least = 0; ///< lower bound of the distance, tight to 2^-48
    Vec3 point_a;        ///< world frame; rounded
    Vec3 gap;            ///< from `point_a` to the point of b
    std::uint32_t steps = 0;
};

/// In          `start`: at least one corner to begin with; weights are not read.
/// Degenerate  points in any position, of any size.
/// Accuracy    every decision is exact; the numbers are rounded.
/// Cost        some microseconds a step, of which there are about a dozen, and some nanoseconds for
///             each point in each step.
/// Source      [Gilbert, Johnson, Keerthi 1988] in integers. The distance shrinks in each step and
///             there are finitely many simplices, so it ends with the closest points.
ExactClosestPoints exact_closest_points(const PlacedPoints& points, const IntegerGrid& grid,
                                        const DifferenceSimplex& start);

} // namespace abut
