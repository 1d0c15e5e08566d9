#include "convex/feature_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "convex/feature_walk.cpp"
#include "simd/foreach_target.h"
#include "convex/climb-inl.h"
#include "convex/placed_xyz-inl.h"
#include "geometry/nearest-inl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using XyzTriangle = std::array<Xyz, 3>;

/// Corners of a feature that hold the closest point: bit 0 its vertex, bit 1 the end of its edge,
/// bit 2 the end of the next edge.
using Corners = std::uint32_t;

/// Closest points of two features, and what of each holds them.
struct Measured {
    Xyz point_a, gap;
    double distance_sq = std::numeric_limits<double>::infinity();
    Corners a = 1, b = 1;
};

HWY_INLINE Measured turned(const Measured& m) {
    return {m.point_a + m.gap, -m.gap, m.distance_sq, m.b, m.a};
}

HWY_INLINE Measured measured(const Xyz& point_a, const Xyz& gap, Corners a, Corners b) {
    return {point_a, gap, length_sq(gap), a, b};
}

/// A point q and the segment from p0 to p1, that of a.
HWY_INLINE Measured measure_edge_vertex(const Xyz& p0, const Xyz& p1, const Xyz& q) {
    const Xyz u = p1 - p0, w = q - p0;
    const double along = dot(w, u), all = length_sq(u);
    if (!(along > 0))
        return measured(p0, w, 1, 1);
    if (along >= all)
        return measured(p1, q - p1, 2, 1);
    const Xyz foot = (along / all) * u;
    return measured(p0 + foot, w - foot, 3, 1);
}

HWY_INLINE Corners corners_at(double parameter) {
    return parameter <= 0 ? 1 : parameter >= 1 ? 2 : 3;
}

HWY_INLINE Measured measure_edge_edge(const Xyz& p0, const Xyz& p1, const Xyz& q0, const Xyz& q1) {
    const Xyz u = p1 - p0, v = q1 - q0, r = q0 - p0;
    const SegmentPoints c = nearest_on_segments(u, v, r);
    const Xyz from = c.s * u;
    return {p0 + from, r + c.t * v - from, c.distance_sq, corners_at(c.s), corners_at(c.t)};
}

/// Corners of a triangle's foot that have weight.
HWY_INLINE Corners corners_of(const Foot<Xyz>& foot) {
    const Corners corners =
        (1 - foot.g - foot.h > 0 ? 1U : 0U) | (foot.g > 0 ? 2U : 0U) | (foot.h > 0 ? 4U : 0U);
    return (corners << foot.first | corners >> (3 - foot.first)) & 7U;
}

/// For each edge of a triangle, what of the triangle corners of that edge are.
constexpr Corners kEdgeCorners[3][4] = {{0, 1, 2, 3}, {0, 2, 4, 6}, {0, 4, 1, 5}};

/// A triangle of a and a point of b that has no foot in it.
HWY_NOINLINE void measure_border_vertex(const XyzTriangle& t, const Xyz& q, Measured& nearest) {
    nearest.distance_sq = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const Measured m = measure_edge_vertex(t[k], t[(k + 1) % 3], q);
        if (!(m.distance_sq < nearest.distance_sq))
            continue;
        nearest = m;
        nearest.a = kEdgeCorners[k][m.a];
    }
}

/// A triangle of a and a point of b.
HWY_INLINE Measured measure_face_vertex(const XyzTriangle& t, const Xyz& q) {
    const Foot<Xyz> foot = foot_on(q, t);
    if (foot.within)
        return measured(foot.point, foot.gap, corners_of(foot), 1);
    Measured nearest;
    measure_border_vertex(t, q, nearest);
    return nearest;
}

/// A triangle of a and the segment from q0 to q1, that of b.
HWY_NOINLINE void measure_face_edge(const XyzTriangle& t, const Xyz& q0, const Xyz& q1,
                                    Measured& nearest) {
    const Xyz normal = cross(t[1] - t[0], t[2] - t[0]);
    const double h0 = dot(normal, q0 - t[0]), h1 = dot(normal, q1 - t[0]);
    const bool pierces_plane = (h0 > 0) != (h1 > 0);
    if (pierces_plane) {
        const Xyz crossing = q0 + (h0 / (h0 - h1)) * (q1 - q0);
        if (foot_on(crossing, t).within) {
            nearest = {crossing, to_xyz({}), 0, 7, 3};
            return;
        }
    }
    nearest.distance_sq = std::numeric_limits<double>::infinity();
    const auto take = [&](const Measured& m) HWY_ATTR {
        if (m.distance_sq < nearest.distance_sq)
            nearest = m;
    };
    // Inside of the triangle only an end of the segment can be nearest, and if the segment stays on
    // one side, only the end that is nearer to the plane: then nothing else is nearer.
    const bool first_is_nearer = std::abs(h0) < std::abs(h1);
    if (const Foot<Xyz> foot = foot_on(first_is_nearer ? q0 : q1, t); foot.within) {
        take(measured(foot.point, foot.gap, corners_of(foot), first_is_nearer ? 1 : 2));
        if (!pierces_plane)
            return;
    }
    if (pierces_plane)
        if (const Foot<Xyz> foot = foot_on(first_is_nearer ? q1 : q0, t); foot.within)
            take(measured(foot.point, foot.gap, corners_of(foot), first_is_nearer ? 2 : 1));
    for (std::size_t k = 0; k < 3; ++k) {
        Measured m = measure_edge_edge(t[k], t[(k + 1) % 3], q0, q1);
        m.a = kEdgeCorners[k][m.a];
        take(m);
    }
}

HWY_INLINE Xyz corner0(const PlacedXyz& side, const HullFeature& f) {
    return side.vertex(f.vertex);
}
HWY_INLINE Xyz corner1(const PlacedXyz& side, const HullFeature& f) {
    return side.place(side.polytope().to(f.edge));
}
HWY_INLINE XyzTriangle triangle(const PlacedXyz& side, const HullFeature& f) {
    const Polytope& p = side.polytope();
    return {corner0(side, f), corner1(side, f),
            side.place(p.to(p.after(p.vertices[f.vertex], f.edge)))};
}

HWY_INLINE Measured measure(const PlacedXyz& side_a, const PlacedXyz& side_b, const HullFeature& a,
                            const HullFeature& b) {
    switch (3 * static_cast<int>(a.kind) + static_cast<int>(b.kind)) {
    case 0: {
        const Xyz p = corner0(side_a, a);
        return measured(p, corner0(side_b, b) - p, 1, 1);
    }
    case 1:
        return turned(
            measure_edge_vertex(corner0(side_b, b), corner1(side_b, b), corner0(side_a, a)));
    case 2:
        return turned(measure_face_vertex(triangle(side_b, b), corner0(side_a, a)));
    case 3:
        return measure_edge_vertex(corner0(side_a, a), corner1(side_a, a), corner0(side_b, b));
    case 4:
        return measure_edge_edge(corner0(side_a, a), corner1(side_a, a), corner0(side_b, b),
                                 corner1(side_b, b));
    case 5: {
        Measured nearest;
        measure_face_edge(triangle(side_b, b), corner0(side_a, a), corner1(side_a, a), nearest);
        return turned(nearest);
    }
    case 6:
        return measure_face_vertex(triangle(side_a, a), corner0(side_b, b));
    default: {
        Measured nearest;
        measure_face_edge(triangle(side_a, a), corner0(side_b, b), corner1(side_b, b), nearest);
        return nearest;
    }
    }
}

/// What remains of a feature of which these corners hold the closest point.
HWY_INLINE void shrink(const Polytope& p, Corners corners, HullFeature& f) {
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

/// How much further along the gap than a feature a neighbour lies at most, and the feature grown
/// towards it.
struct Growth {
    double excess = 0;
    HullFeature feature;
    bool possible = false;
};

/// `tolerance_sq`: the square of an excess that is rounding.
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
            return {most, {f.vertex, left ? f.edge : right, Feature::face}, most > 0};
        // Between coplanar triangles: a part of a face, whose side only the others tell.
    }
    const HighestNeighbour h = highest_neighbour(p, v, n);
    return {h.excess, {f.vertex, h.edge, Feature::edge}, h.excess > 0 && f.kind == Feature::vertex};
}

void walk_features(const PolytopePair& pair, double rounding, std::uint32_t limit,
                   WalkState& state) {
    const PlacedXyz side_a(pair.a), side_b(pair.b);
    const double rounding_sq = rounding * rounding;
    HullFeature a = state.a, b = state.b; ///< the pair that was accepted last
    HullFeature next_a = a, next_b = b;   ///< the pair to measure
    Growth grown_a{}, grown_b{};
    Xyz point_a = to_xyz({}), gap = point_a;
    double distance_sq = std::numeric_limits<double>::infinity(), excess = 0;
    std::uint32_t count = 0;
    WalkEnd end = WalkEnd::closest;
    for (;;) {
        const Measured next = measure(side_a, side_b, next_a, next_b);
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
        // The larger excess first. What has been tried is not possible any more.
        next_a = a, next_b = b;
        if (grown_a.possible && !(grown_b.possible && grown_b.excess > grown_a.excess)) {
            next_a = grown_a.feature;
            grown_a.possible = false;
        } else if (grown_b.possible) {
            next_b = grown_b.feature;
            grown_b.possible = false;
        } else {
            end = WalkEnd::stuck;
            break;
        }
    }
    state.a = a, state.b = b;
    state.point_a = to_vec3(point_a), state.gap = to_vec3(gap);
    state.distance_sq = distance_sq, state.excess = excess;
    state.feature_pairs += count;
    state.end = end;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(walk_features);

void walk(const PolytopePair& pair, double rounding, std::uint32_t limit, WalkState& state) {
    HWY_DYNAMIC_DISPATCH(walk_features)(pair, rounding, limit, state);
}

} // namespace abut
#endif
