#pragma once

#include "convex/body/convex_data.h"
#include "convex/proof/placed_points.h"
#include "convex/search/closest_points.h"

#include <span>

namespace abut {

/// Two bodies and where they are.
struct PlacedConvexPair {
    const ConvexData &a, &b;
    const Transform &world_from_a, &world_from_b;

    [[nodiscard]] PolytopePair pair() const {
        return {a.levels[0].polytope, world_from_a, b.levels[0].polytope, world_from_b};
    }
    [[nodiscard]] PlacedPoints points() const {
        return {placed_points(a, world_from_a), placed_points(b, world_from_b)};
    }
    /// What points that the polytopes do without may take from a distance.
    [[nodiscard]] double outside() const {
        return sum_of_sizes(world_from_a) * a.outside + sum_of_sizes(world_from_b) * b.outside;
    }
};

struct CertainDistance {
    double distance = 0, at_least = 0;
};

/// The largest height of a body along a direction, in the pair's frame.
double highest(const PlacedPolytope& side, std::span<const Vec3> left_out, const Vec3& direction);

/// A length that the distance of two polytopes is not below, without a doubt, by a look at all
/// vertices along the gap that a search has found, and along what is across its features. May be
/// negative.
///
/// In          `left_out_a`, `left_out_b`: more points of each.
double certain_distance(const PolytopePair& pair, std::span<const Vec3> left_out_a,
                        std::span<const Vec3> left_out_b, double rounding, const WalkState& at);

/// Whether two polytopes meet for sure in a face of one and an edge of the other, as a search that has
/// ended without a simplex says.
bool surely_meet(const PolytopePair& pair, double rounding, const WalkState& at);

/// A distance that is certain to so much is right.
inline bool is_tight(double bound, double distance, double rounding) {
    return bound > 0 && bound >= distance * (1 - 0x1p-40) - 12 * rounding;
}

/// Proves what a search on the bodies' own polytopes has found but not proven, or replaces it by what
/// integers say.
///
/// In/out      `search`: all of it; then proven.
/// Out         returns the distance, and what it is not below. Both are 0 if, and only if, the bodies
///             meet; the distance only then.
/// Errors      Error{bad_argument} if a vertex is placed beyond the range of doubles.
/// Frame       the pair's.
CertainDistance settle_gap(const PlacedConvexPair& bodies, double rounding,
                           ClosestPointSearch& search);

} // namespace abut
