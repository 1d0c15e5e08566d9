#pragma once

#include "convex/body/convex_data.h"
#include "convex/proof/placed_points.h"
#include "convex/search/closest_points.h"

#include <span>

namespace abut {

/// Two bodies under their transforms.
struct PlacedConvexPair {
    const ConvexData &a, &b;
    const Transform &world_from_a, &world_from_b;

    [[nodiscard]] PolytopePair pair() const {
        return {a.levels[0].polytope, world_from_a, b.levels[0].polytope, world_from_b};
    }
    [[nodiscard]] PlacedPoints points() const {
        return {placed_points(a, world_from_a), placed_points(b, world_from_b)};
    }
    /// What points that the polytopes leave out may take from a distance.
    [[nodiscard]] double outside() const {
        return sum_of_sizes(world_from_a) * a.outside + sum_of_sizes(world_from_b) * b.outside;
    }
};

struct CertainDistance {
    double distance = 0, at_least = 0;
};

/// The largest height of a body along a direction, in the pair's frame.
double highest(const PlacedPolytope& side, std::span<const Vec3> left_out, const Vec3& direction);

/// A certain lower bound of the distance of two polytopes, which may be negative. All vertices are
/// compared along the gap that a search has found, and along the direction perpendicular to its
/// features.
///
/// In          `left_out_a`, `left_out_b`: further points of each body.
double certain_distance(const PolytopePair& pair, std::span<const Vec3> left_out_a,
                        std::span<const Vec3> left_out_b, double rounding, const WalkState& at);

/// Returns whether two polytopes certainly meet in a face of one and an edge of the other, given a
/// search that ended as `meeting` without a simplex.
bool surely_meet(const PolytopePair& pair, double rounding, const WalkState& at);

/// Returns whether a lower bound is close enough to a distance to prove it.
inline bool is_tight(double bound, double distance, double rounding) {
    return bound > 0 && bound >= distance * (1 - 0x1p-40) - 12 * rounding;
}

/// Proves what a search on the bodies' own polytopes has found but not proven, or replaces it by an
/// answer in integers.
///
/// In/out      `search`: all of it; proven afterwards.
/// Out         returns the distance and a lower bound. Both are 0 if the bodies meet; the distance
///             is 0 only then.
/// Errors      Error{bad_argument} if a vertex is placed beyond the range of doubles.
/// Frame       the pair's.
CertainDistance settle_gap(const PlacedConvexPair& bodies, double rounding,
                           ClosestPointSearch& search);

} // namespace abut
