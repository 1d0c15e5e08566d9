#include "convex/search/voronoi_marching.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "convex/search/voronoi_marching.cpp"
#include "simd/foreach_target.h"
#include "convex/hull/climb-inl.h"
#include "convex/hull/placed_xyz-inl.h"
#include "convex/search/feature_pair-inl.h"
#include "convex/search/neighbours-inl.h"

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Shrinks a feature to the part of it whose corners hold the closest point.
HWY_INLINE void shrink(const Polytope& p, Corners corners, HullFeature& f) {
    // Most often all of the feature stays: of a vertex corner 1, of an edge 3, of a face 7.
    if (corners == (2U << static_cast<std::uint32_t>(f.kind)) - 1) [[likely]]
        return;
    const std::uint32_t next = f.kind == Feature::face ? p.after(p.vertices[f.vertex], f.edge) : 0;
    switch (corners) {
    case 1:
        f.kind = Feature::vertex;
        break;
    case 2:
        f.vertex = p.target(f.edge);
        f.kind = Feature::vertex;
        break;
    case 3:
        f.kind = Feature::edge;
        break;
    case 4:
        f.vertex = p.target(next);
        f.kind = Feature::vertex;
        break;
    case 5:
        f.edge = next;
        f.kind = Feature::edge;
        break;
    case 6:
        f.vertex = p.target(f.edge);
        f.edge = p.before(p.vertices[f.vertex], p.twin(f.edge));
        f.kind = Feature::edge;
        break;
    default:
        break;
    }
}

/// The largest excess of a neighbour along the gap over a feature, and the feature grown towards
/// that neighbour.
struct Growth {
    double excess = 0;
    HullFeature feature;
    bool possible = false;
    /// The excess with its sign: negative if all neighbours lie behind the feature. For a triangle,
    /// the excess of the neighbour farthest behind it, which tells on which side of it the body is.
    double most = 0;
};

/// Grows a feature. `tolerance_sq`: the square of an excess that may be rounding.
HWY_INLINE Growth grow(const PlacedXyz& side, const HullFeature& f, const Xyz& gap,
                       double tolerance_sq) {
    const Polytope& p = side.polytope();
    const Vec3 n = to_vec3(side.pulled_back(gap));
    const HullVertex& v = p.vertices[f.vertex];
    const auto excess = [&](std::uint32_t edge) HWY_ATTR { return dot(n, p.to(edge) - v.at); };
    if (f.kind == Feature::edge) {
        const std::uint32_t right = p.before(v, f.edge);
        const double to_left = excess(p.after(v, f.edge)), to_right = excess(right);
        const bool left = to_left >= to_right;
        const double most = left ? to_left : to_right;
        if (most * most > tolerance_sq)
            return {most, {f.vertex, left ? f.edge : right, Feature::face}, most > 0, most};
        // An edge between coplanar triangles is part of a face; only other neighbours tell the
        // body's side.
    }
    const bool is_face = f.kind == Feature::face;
    const rings::HighestNeighbour h = rings::highest_neighbour(p, v, n, is_face);
    // Neighbours of a triangle that is seen from its front are no farther along its normal. What
    // exceeds it is rounding of a short gap's direction.
    if (is_face && -h.least > h.most)
        return {0, f, false, h.least};
    return {h.excess,
            {f.vertex, h.edge, Feature::edge},
            h.excess > 0 && f.kind == Feature::vertex,
            is_face ? h.least : h.most};
}

/// Replaces a feature by its growth with the larger excess that has not been tried yet. Returns
/// false if both have been tried.
HWY_INLINE bool take_larger(Growth& grown_a, Growth& grown_b, HullFeature& a, HullFeature& b) {
    if (grown_a.possible && !(grown_b.possible && grown_b.excess > grown_a.excess)) {
        a = grown_a.feature;
        grown_a.possible = false;
        return true;
    }
    if (!grown_b.possible)
        return false;
    b = grown_b.feature;
    grown_b.possible = false;
    return true;
}

/// Returns whether the features' neighbours lie behind them by more than rounding explains
/// (docs/convex.md, "Proofs"). `most` as in Growth.
HWY_INLINE bool is_proof(double most, double spread_sq, double distance_sq, double rounding_sq) {
    const double spread = std::min(spread_sq, distance_sq);
    return most < 0 && spread * spread >= 0x1p12 * rounding_sq * distance_sq &&
           most * most * spread > 0x1p125 * (rounding_sq * rounding_sq) * (spread + distance_sq);
}

void walk_features(const PolytopePair& pair, double rounding, std::uint32_t limit,
                   WalkState& state) {
    const PlacedXyz side_a(pair.a), side_b(pair.b);
    const double rounding_sq = rounding * rounding;
    HullFeature a = state.a, b = state.b; ///< the pair that was accepted last
    HullFeature next_a = a, next_b = b;   ///< the pair to measure
    Growth grown_a{}, grown_b{};
    Xyz point_a, gap;
    double distance_sq = std::numeric_limits<double>::infinity(), excess = 0;
    std::uint32_t count = 0;
    WalkEnd end = WalkEnd::closest;
    Measured next;
    EdgePair edges;
    for (;;) {
        next = measure(side_a, side_b, next_a, next_b, edges);
        ++count;
        if (next.distance_sq < distance_sq) {
            a = next_a, b = next_b;
            shrink(*pair.a.polytope, next.a, a);
            shrink(*pair.b.polytope, next.b, b);
            point_a = next.point_a, gap = next.gap, distance_sq = next.distance_sq;
            if (!(distance_sq > rounding_sq)) {
                end = WalkEnd::meeting;
                break;
            }
            const double tolerance_sq = rounding_sq * distance_sq;
            grown_a = grow(side_a, a, gap, tolerance_sq);
            grown_b = grow(side_b, b, -gap, tolerance_sq);
            excess = std::max(grown_a.excess, 0.0) + std::max(grown_b.excess, 0.0);
            if (excess * excess <= tolerance_sq)
                break;
        }
        if (count >= limit) {
            end = WalkEnd::limit;
            break;
        }
        next_a = a, next_b = b;
        if (!take_larger(grown_a, grown_b, next_a, next_b)) {
            end = WalkEnd::stuck;
            break;
        }
    }
    state.a = a, state.b = b;
    state.point_a = to_vec3(point_a), state.gap = to_vec3(gap);
    state.distance_sq = distance_sq, state.excess = excess;
    state.feature_pairs += count;
    state.end = end;
    state.of_features = true;
    state.proven = false;
    if (end != WalkEnd::closest)
        return;
    // The pair measured last is the one that ended the walk.
    const double spread_sq = next.spread_sq == kOfEdges
                                 ? spread_of_edges(edges, gap, distance_sq, next.a, next.b)
                                 : next.spread_sq;
    state.proven =
        is_proof(std::max(grown_a.most, grown_b.most), spread_sq, distance_sq, rounding_sq);
}

/// A direction perpendicular to two features, towards either side, and the square of a length s:
/// rounding of the corners by e turns it by at most 32 e / s. Zero if there is none.
struct Perpendicular {
    Xyz n;
    double spread_sq = 0;
};

HWY_INLINE Xyz edge_of(const PlacedXyz& side, const HullFeature& f) {
    return corner1(side, f) - corner0(side, f);
}

/// To an edge, and to nothing else: the gap without its part along the edge.
HWY_INLINE Perpendicular perpendicular_to_edge(const Xyz& u, const Xyz& gap) {
    const double uu = length_sq(u);
    const Xyz n = gap - (dot(gap, u) / uu) * u;
    const double along = dot(n, u);
    return {n, along * along <= 0x1p-98 * length_sq(n) * uu ? uu : 0};
}

HWY_INLINE Perpendicular perpendicular_to_edges(const Xyz& u, const Xyz& v) {
    const Xyz n = cross(u, v);
    return {n, length_sq(n) / std::max(length_sq(u), length_sq(v))};
}

HWY_INLINE Perpendicular perpendicular_to_triangle(const XyzTriangle& t) {
    const Xyz u = t[1] - t[0], v = t[2] - t[0];
    const Xyz n = cross(u, v);
    const double longest_sq = std::max({length_sq(u), length_sq(v), length_sq(t[2] - t[1])});
    return {n, length_sq(n) / longest_sq};
}

HWY_INLINE Perpendicular perpendicular_to(const PlacedXyz& side_a, const PlacedXyz& side_b,
                                          const HullFeature& a, const HullFeature& b,
                                          const Xyz& gap) {
    switch (3 * static_cast<int>(a.kind) + static_cast<int>(b.kind)) {
    case 0:
        return {gap, std::numeric_limits<double>::infinity()};
    case 1:
        return perpendicular_to_edge(edge_of(side_b, b), gap);
    case 2:
        return perpendicular_to_triangle(triangle(side_b, b));
    case 3:
        return perpendicular_to_edge(edge_of(side_a, a), gap);
    case 4:
        return perpendicular_to_edges(edge_of(side_a, a), edge_of(side_b, b));
    case 6:
        return perpendicular_to_triangle(triangle(side_a, a));
    default:
        return {};
    }
}

bool compare_across(const PolytopePair& pair, double rounding, const WalkState& state) {
    const PlacedXyz side_a(pair.a), side_b(pair.b);
    const Xyz gap = to_xyz(state.gap);
    const Perpendicular across = perpendicular_to(side_a, side_b, state.a, state.b, gap);
    const double rounding_sq = rounding * rounding, nn = length_sq(across.n),
                 along = dot(across.n, gap), distance_sq = state.distance_sq;
    const double least = std::sqrt(distance_sq) - 0.5 * rounding;
    if (!(rounding > 0x1p-100 && across.spread_sq >= 0x1p20 * rounding_sq &&
          distance_sq <= std::min(across.spread_sq, 0x1p90 * rounding_sq) && least > 0 &&
          along * along >= nn * (least * least)))
        return false;
    const Xyz n = choose(along < 0, -across.n, across.n);
    const double most =
        std::max(excess_along(side_a, state.a, n), excess_along(side_b, state.b, -n));
    return most < 0 && most * most > 0x1p10 * rounding_sq * nn &&
           most * most * across.spread_sq > 0x1p123 * (rounding_sq * rounding_sq) * nn;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(walk_features);
HWY_EXPORT(compare_across);

void walk(const PolytopePair& pair, double rounding, std::uint32_t limit, WalkState& state) {
    HWY_DYNAMIC_DISPATCH(walk_features)(pair, rounding, limit, state);
}

bool is_proven_across(const PolytopePair& pair, double rounding, const WalkState& state) {
    return state.end == WalkEnd::closest && state.of_features &&
           HWY_DYNAMIC_DISPATCH(compare_across)(pair, rounding, state);
}

} // namespace abut
#endif
