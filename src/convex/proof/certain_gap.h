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

/// Lower bounds of the distance of two polytopes, which may be negative.
struct DistanceBounds {
    double in_frame = 0; ///< for the polytopes in the pair's frame
    double certain = 0;  ///< for their vertices at the rounded positions of abut/types.h
};

/// Bounds the distance of two polytopes from below. All vertices are compared along the gap that a
/// search has found, and along the direction perpendicular to its features.
///
/// In          `left_out_a`, `left_out_b`: further points of each body.
DistanceBounds distance_bounds(const PolytopePair& pair, std::span<const Vec3> left_out_a,
                               std::span<const Vec3> left_out_b, double rounding,
                               const WalkState& at);

/// Returns whether two polytopes certainly meet in a face of one and an edge of the other, given a
/// search that ended as `meeting` without a simplex.
bool surely_meet(const PolytopePair& pair, double rounding, const WalkState& at);

/// Returns whether lower bounds are close enough to a distance to prove it. How far the bodies are
/// from the world's origin matters only for whether they are apart at all: a distance that a search
/// has not found to the rounding in the pair's frame is not the distance, wherever the bodies are.
///
/// In          rounding: of a coordinate in the pair's frame.
inline bool is_tight_in_frame(const DistanceBounds& bounds, double distance, double rounding) {
    return bounds.in_frame >= distance * (1 - 0x1p-40) - 12 * rounding;
}
inline bool is_tight(const DistanceBounds& bounds, double distance, double rounding) {
    return bounds.certain > 0 && is_tight_in_frame(bounds, distance, rounding);
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
