#include "convex/feature_walk.h"

#include "convex/climb.h"
#include "geometry/point_triangle_distance.h"
#include "geometry/triangle_triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Corners of a feature that hold the closest point: bit 0 its vertex, bit 1 the end of its edge,
/// bit 2 the end of the next edge.
using Corners = std::uint32_t;

/// Closest points of two features, and what of each holds them.
struct Measured {
    Vec3 point_a, gap;
    double distance_sq = std::numeric_limits<double>::infinity();
    Corners a = 1, b = 1;
};

inline Measured turned(const Measured& m) {
    return {m.point_a + m.gap, -m.gap, m.distance_sq, m.b, m.a};
}

inline Measured measured(const Vec3& point_a, const Vec3& gap, Corners a, Corners b) {
    return {point_a, gap, length_sq(gap), a, b};
}

/// A point q and the segment from p0 to p1, that of a.
inline Measured measure_edge_vertex(const Vec3& p0, const Vec3& p1, const Vec3& q) {
    const Vec3 u = p1 - p0, w = q - p0;
    const double along = dot(w, u), all = length_sq(u);
    if (!(along > 0))
        return measured(p0, w, 1, 1);
    if (along >= all)
        return measured(p1, q - p1, 2, 1);
    const Vec3 foot = (along / all) * u;
    return measured(p0 + foot, w - foot, 3, 1);
}

inline Corners corners_at(double parameter) {
    return parameter <= 0 ? 1 : parameter >= 1 ? 2 : 3;
}

inline Measured measure_edge_edge(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
    const Vec3 u = p1 - p0, v = q1 - q0, r = q0 - p0;
    const SegmentPoints c = nearest_on_segments(u, v, r);
    const Vec3 from = c.s * u;
    return {p0 + from, r + c.t * v - from, c.distance_sq, corners_at(c.s), corners_at(c.t)};
}

Corners corners_with(const std::array<double, 3>& weights) {
    return (weights[0] > 0 ? 1U : 0U) | (weights[1] > 0 ? 2U : 0U) | (weights[2] > 0 ? 4U : 0U);
}

/// A triangle of a and a point of b.
Measured measure_face_vertex(const Triangle& t, const Vec3& q) {
    const TriangleFoot foot = foot_within(q, t);
    if (foot.within)
        return measured(foot.point, foot.gap, corners_with(foot.weights), 1);
    const NearestOnTriangle n = nearest_on_triangle(q, t);
    return measured(n.point, q - n.point, corners_with(n.weights), 1);
}

/// A triangle of a and the segment from q0 to q1, that of b.
Measured measure_face_edge(const Triangle& t, const Vec3& q0, const Vec3& q1) {
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    const double h0 = dot(normal, q0 - t[0]), h1 = dot(normal, q1 - t[0]);
    const bool pierces_plane = (h0 > 0) != (h1 > 0);
    if (pierces_plane) {
        const Vec3 crossing = q0 + (h0 / (h0 - h1)) * (q1 - q0);
        if (foot_within(crossing, t).within)
            return {crossing, {}, 0, 7, 3};
    }
    Measured best;
    const auto take = [&](const Measured& m) {
        if (m.distance_sq < best.distance_sq)
            best = m;
    };
    // Inside of the triangle only an end of the segment can be nearest, and if the segment stays on
    // one side, only the end that is nearer to the plane: then nothing else is nearer.
    const bool first_is_nearer = std::abs(h0) < std::abs(h1);
    if (const TriangleFoot foot = foot_within(first_is_nearer ? q0 : q1, t); foot.within) {
        take(measured(foot.point, foot.gap, corners_with(foot.weights), first_is_nearer ? 1 : 2));
        if (!pierces_plane)
            return best;
    }
    if (pierces_plane)
        if (const TriangleFoot foot = foot_within(first_is_nearer ? q1 : q0, t); foot.within)
            take(measured(foot.point, foot.gap, corners_with(foot.weights),
                          first_is_nearer ? 2 : 1));
    constexpr Corners kEdgeCorners[3][4] = {{0, 1, 2, 3}, {0, 2, 4, 6}, {0, 4, 1, 5}};
    for (std::size_t k = 0; k < 3; ++k) {
        Measured m = measure_edge_edge(t[k], t[(k + 1) % 3], q0, q1);
        m.a = kEdgeCorners[k][m.a];
        take(m);
    }
    return best;
}

inline Vec3 corner0(const PlacedPolytope& side, const HullFeature& f) {
    return side.place(side.polytope->vertices[f.vertex].at);
}
inline Vec3 corner1(const PlacedPolytope& side, const HullFeature& f) {
    return side.place(side.polytope->to(f.edge));
}
inline Triangle triangle(const PlacedPolytope& side, const HullFeature& f) {
    const Polytope& p = *side.polytope;
    return {corner0(side, f), corner1(side, f),
            side.place(p.to(p.after(p.vertices[f.vertex], f.edge)))};
}

inline Measured measure(const PolytopePair& pair, const HullFeature& a, const HullFeature& b) {
    switch (3 * static_cast<int>(a.kind) + static_cast<int>(b.kind)) {
    case 0: {
        const Vec3 p = corner0(pair.a, a);
        return measured(p, corner0(pair.b, b) - p, 1, 1);
    }
    case 1:
        return turned(
            measure_edge_vertex(corner0(pair.b, b), corner1(pair.b, b), corner0(pair.a, a)));
    case 2:
        return turned(measure_face_vertex(triangle(pair.b, b), corner0(pair.a, a)));
    case 3:
        return measure_edge_vertex(corner0(pair.a, a), corner1(pair.a, a), corner0(pair.b, b));
    case 4:
        return measure_edge_edge(corner0(pair.a, a), corner1(pair.a, a), corner0(pair.b, b),
                                 corner1(pair.b, b));
    case 5:
        return turned(
            measure_face_edge(triangle(pair.b, b), corner0(pair.a, a), corner1(pair.a, a)));
    case 6:
        return measure_face_vertex(triangle(pair.a, a), corner0(pair.b, b));
    default:
        return measure_face_edge(triangle(pair.a, a), corner0(pair.b, b), corner1(pair.b, b));
    }
}

/// What remains of a feature of which these corners hold the closest point.
inline void shrink(const Polytope& p, Corners corners, HullFeature& f) {
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
inline Growth grow(const PlacedPolytope& side, const HullFeature& f, const Vec3& gap,
                   double tolerance_sq) {
    const Polytope& p = *side.polytope;
    const Vec3 n = side.pulled_back(gap);
    const HullVertex& v = p.vertices[f.vertex];
    const auto excess = [&](std::uint32_t edge) { return dot(n, p.to(edge) - v.at); };
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

} // namespace

void walk(const PolytopePair& pair, double rounding, std::uint32_t limit, WalkState& state) {
    const double rounding_sq = rounding * rounding;
    HullFeature a = state.a, b = state.b; ///< the pair that was accepted last
    HullFeature next_a = a, next_b = b;   ///< the pair to measure
    Growth grown_a{}, grown_b{};
    Vec3 point_a, gap;
    double distance_sq = std::numeric_limits<double>::infinity(), excess = 0;
    std::uint32_t count = 0;
    WalkEnd end = WalkEnd::closest;
    for (;;) {
        const Measured next = measure(pair, next_a, next_b);
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
            grown_a = grow(pair.a, a, gap, tolerance_sq);
            grown_b = grow(pair.b, b, -gap, tolerance_sq);
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
    state.point_a = point_a, state.gap = gap;
    state.distance_sq = distance_sq, state.excess = excess;
    state.feature_pairs += count;
    state.end = end;
}

} // namespace abut
