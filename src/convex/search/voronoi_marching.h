#pragma once

#include <abut/types.h>

#include "convex/hull/placed_polytope.h"

#include <cstdint>

namespace abut {

/// A feature of a polytope: a vertex; its edge; or the triangle between that edge and the next
/// around the vertex.
struct HullFeature {
    std::uint32_t vertex = 0, edge = 0;
    Feature kind = Feature::vertex;
};

enum class WalkEnd : std::uint8_t {
    closest, ///< the features hold a pair of closest points of the polytopes
    meeting, ///< they share a point, to rounding: so the polytopes do
    limit,   ///< not yet there after the pairs allowed
    stuck,   ///< nothing that may grow brings them nearer: a triangle whose back side the other
             ///< polytope sees, as where they meet; or rounding
};

/// Where a walk stands: two features, and the points of them that are closest, inside of each.
struct WalkState {
    HullFeature a, b;
    Vec3 point_a; ///< in the pair's frame
    Vec3 gap;     ///< to the point of b
    double distance_sq = 0;
    double excess = 0; ///< no point is nearer than the distance less this over the distance
    std::uint32_t feature_pairs = 0; ///< that were measured
    WalkEnd end = WalkEnd::closest;
    /// closest: without a doubt no point is nearer than the distance less eight times the rounding, if
    /// is_measurable(distance_sq, rounding).
    bool proven = false;
};

/// Returns whether a distance is so much larger than rounding, and rounding so much larger than underflow,
/// that `walk` compares squared distances reliably.
inline bool is_measurable(double distance_sq, double rounding) {
    return rounding > 0x1p-100 && distance_sq > 0x1p40 * rounding * rounding;
}

inline constexpr std::uint32_t kNoLimit = 0xffffffffU;

/// Walks from a pair of features to the closest ones.
///
/// A step measures the two features. If the gap g between them is in the normal cones of both, no
/// point of either polytope is nearer: its vertex is the farthest of all along g. If a neighbour w
/// of a feature with the closest point p lies further along, g . (w - p) > 0, the feature grows
/// towards it, vertex to edge or edge to triangle, and the distance shrinks; a pair of closest
/// points on the border of the grown features lets them shrink to what holds it. So no pair of
/// features comes twice.
///
/// In/out      `state`: features of the two polytopes, in any combination but two triangles; all of
///             it is set. `rounding`: a length, that of the rounding of the coordinates in the
///             pair's frame. `limit`: of the pairs that are measured.
/// Accuracy    closest: no point is nearer by more than a few times `rounding`.
/// Source      [Lin, Canny 1991], [Mirtich 1998] (V-Clip). Differs: normal cones in place of Voronoi
///             planes, which need nothing but the neighbours' positions and stay right under
///             any affine transform; a measured distance must shrink, so there is nothing to cycle.
void walk(const PolytopePair& pair, double rounding, std::uint32_t limit, WalkState& state);

inline HullFeature vertex_feature(std::uint32_t vertex) {
    return {vertex, 0, Feature::vertex};
}

} // namespace abut
