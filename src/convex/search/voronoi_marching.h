// Voronoi marching (SWIFT's name; Lin-Canny, V-Clip): closest features of two convex polytopes.
//
// A walk keeps one feature (vertex, edge or triangle) of each polytope. While a neighbour of a
// feature is nearer to the other one, the walk moves to it. It ends where the gap between both
// features lies in the normal cones of both: convexity then proves that no points are nearer.
// Between similar poses the closest features are the same or adjacent, so a walk from the last
// answer takes few steps.

#pragma once

#include <abut/types.h>

#include "convex/hull/placed_polytope.h"

#include <cstdint>

namespace abut {

/// A feature of a polytope: a vertex; an edge that leaves it; or the triangle between that edge and
/// the next one around the vertex.
struct HullFeature {
    std::uint32_t vertex = 0, edge = 0;
    Feature kind = Feature::vertex;
};

enum class WalkEnd : std::uint8_t {
    closest, ///< the features hold a pair of closest points of the polytopes
    meeting, ///< the features share a point, to rounding: the polytopes meet
    limit,   ///< not finished after the allowed number of pairs
    stuck,   ///< no growth shortens the gap: most often the polytopes meet
};

/// The state of a walk: two features, and their closest points, which lie inside them.
struct WalkState {
    HullFeature a, b;
    Vec3 point_a; ///< in the pair's frame
    Vec3 gap;     ///< to the point of b
    double distance_sq = 0;
    double excess = 0;               ///< no two points are nearer than distance - excess / distance
    std::uint32_t feature_pairs = 0; ///< feature pairs measured
    WalkEnd end = WalkEnd::closest;
    /// If closest: certainly no two points are nearer than the distance less eight roundings,
    /// provided that is_measurable(distance_sq, rounding).
    bool proven = false;
    /// The points are the closest ones of the two features, which hold them in their inside; not
    /// set by a search by simplices.
    bool of_features = false;
};

/// Returns whether the distance is so much larger than rounding, and rounding so much larger than
/// underflow, that `walk` compares squared distances reliably.
inline bool is_measurable(double distance_sq, double rounding) {
    return rounding > 0x1p-100 && distance_sq > 0x1p40 * rounding * rounding;
}

inline constexpr std::uint32_t kNoLimit = 0xffffffffU;

/// Walks from a pair of features to the closest ones.
///
/// A step measures the two features. If the gap g between their closest points lies in the normal
/// cones of both, no point of either polytope is nearer: each vertex of the feature is a farthest
/// one along g. Otherwise some neighbour w of a feature with the closest point p lies further along
/// g, g . (w - p) > 0. The feature grows towards w, vertex to edge or edge to triangle, and the
/// distance shrinks. If a closest point of the grown features lies on a border, the feature shrinks
/// to that border. As the distance shrinks, no pair of features is accepted twice.
///
/// In/out      `state`: features of the two polytopes, in any combination except two triangles; all
///             of it is set. `rounding`: a length that bounds the error of coordinates in the
///             pair's frame. `limit`: on the number of measured pairs.
/// Accuracy    closest: no point is nearer by more than a few times `rounding`.
/// Source      [Lin, Canny 1991], [Mirtich 1998] (V-Clip). Differs: normal cones replace Voronoi
///             planes; they need only the neighbours' positions and hold under any affine
///             transform. The measured distance must shrink, so the walk cannot cycle.
void walk(const PolytopePair& pair, double rounding, std::uint32_t limit, WalkState& state);

/// Proves what a walk has found at a short gap, whose direction has lost digits: neighbours are
/// compared along the direction perpendicular to both features (docs/convex.md, "Proofs").
///
/// Out         if true, no two points are nearer than the distance less eight roundings.
bool is_proven_across(const PolytopePair& pair, double rounding, const WalkState& state);

inline HullFeature vertex_feature(std::uint32_t vertex) {
    return {vertex, 0, Feature::vertex};
}

} // namespace abut
