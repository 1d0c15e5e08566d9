#include "convex/feature_walk.h"

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

Measured turned(const Measured& m) {
    return {m.point_a + m.gap, -m.gap, m.distance_sq, m.b, m.a};
}

Measured measured(const Vec3& point_a, const Vec3& gap, Corners a, Corners b) {
    return {point_a, gap, length_sq(gap), a, b};
}

/// A point q and the segment from p0 to p1, that of a.
Measured measure_edge_vertex(const Vec3& p0, const Vec3& p1, const Vec3& q) {
    const Vec3 u = p1 - p0, w = q - p0;
    const double along = dot(w, u), all = length_sq(u);
    if (!(along > 0))
        return measured(p0, w, 1, 1);
    if (along >= all)
        return measured(p1, q - p1, 2, 1);
    const Vec3 foot = (along / all) * u;
    return measured(p0 + foot, w - foot, 3, 1);
}

Corners corners_at(double parameter) {
    return parameter <= 0 ? 1 : parameter >= 1 ? 2 : 3;
}

Measured measure_edge_edge(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
    const Vec3 u = p1 - p0, v = q1 - q0, r = q0 - p0;
    const SegmentPoints c = nearest_on_segments(u, v, r);
    const Vec3 from = c.s * u;
    return {p0 + from, r + c.t * v - from, c.distance_sq, corners_at(c.s), corners_at(c.t)};
}

/// A triangle of a and a point of b.
Measured measure_face_vertex(const Triangle& t, const Vec3& q) {
    const TriangleFoot foot = foot_within(q, t);
    if (foot.within)
        return measured(foot.point, foot.gap, 7, 1);
    const NearestOnTriangle n = nearest_on_triangle(q, t);
    const Corners corners = n.dimension == 0   ? 1U << n.index
                            : n.dimension == 2 ? 7U
                                               : (n.index == 2 ? 5U : 3U << n.index);
    return measured(n.point, q - n.point, corners, 1);
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
        take(measured(foot.point, foot.gap, 7, first_is_nearer ? 1 : 2));
        if (!pierces_plane)
            return best;
    }
    if (pierces_plane)
        if (const TriangleFoot foot = foot_within(first_is_nearer ? q1 : q0, t); foot.within)
            take(measured(foot.point, foot.gap, 7, first_is_nearer ? 2 : 1));
    constexpr Corners kEdgeCorners[3][4] = {{0, 1, 2, 3}, {0, 2, 4, 6}, {0, 4, 1, 5}};
    for (std::size_t k = 0; k < 3; ++k) {
        Measured m = measure_edge_edge(t[k], t[(k + 1) % 3], q0, q1);
        m.a = kEdgeCorners[k][m.a];
        take(m);
    }
    return best;
}

/// A feature of one side, and what of it is placed.
struct Placed {
    const PolytopePair::Side& side;
    HullFeature feature;

    [[nodiscard]] const HullVertex& vertex() const {
        return side.polytope->vertices[feature.vertex];
    }
    [[nodiscard]] Vec3 corner0() const { return side.place(vertex().at); }
    [[nodiscard]] Vec3 corner1() const {
        return side.place(side.polytope->edges[feature.edge].to);
    }
    [[nodiscard]] Vec3 corner2() const {
        return side.place(
            side.polytope->edges[side.polytope->after(vertex(), feature.edge)].to);
    }
    [[nodiscard]] Triangle triangle() const { return {corner0(), corner1(), corner2()}; }

    /// The feature that the corners are those of.
    [[nodiscard]] HullFeature part(Corners corners) const {
        const Polytope& p = *side.polytope;
        const std::uint32_t edge = feature.edge;
        switch (corners) {
        case 1:
            return vertex_feature(feature.vertex);
        case 2:
            return vertex_feature(p.edges[edge].target);
        case 4:
            return vertex_feature(p.edges[p.after(vertex(), edge)].target);
        case 5:
            return {feature.vertex, p.after(vertex(), edge), Feature::edge};
        case 6: {
            const std::uint32_t end = p.edges[edge].target;
            return {end, p.before(p.vertices[end], p.edges[edge].twin), Feature::edge};
        }
        default: // the whole
            return feature;
        }
    }

    /// How much further along the gap than this feature a neighbour lies at most, and the feature
    /// grown towards it.
    struct Growth {
        double excess;
        HullFeature feature;
    };
    [[nodiscard]] Growth growth(const Vec3& gap) const {
        const Polytope& p = *side.polytope;
        const Vec3 n = side.map.pulled_back(gap);
        const HullVertex& v = vertex();
        const auto excess = [&](std::uint32_t edge) { return dot(n, p.edges[edge].to - v.at); };
        if (feature.kind == Feature::edge) {
            const std::uint32_t left = p.after(v, feature.edge), right = p.before(v, feature.edge);
            const double to_left = excess(left), to_right = excess(right);
            if (to_left >= to_right)
                return {to_left, {feature.vertex, feature.edge, Feature::face}};
            return {to_right, {feature.vertex, right, Feature::face}};
        }
        double most = 0;
        std::uint32_t best = v.first_edge;
        for (std::uint32_t e = v.first_edge; e < v.first_edge + v.degree; ++e)
            if (const double x = excess(e); x > most)
                most = x, best = e;
        return {most, {feature.vertex, best, Feature::edge}};
    }
};

Measured measure(const Placed& a, const Placed& b) {
    const auto kinds = 3 * static_cast<int>(a.feature.kind) + static_cast<int>(b.feature.kind);
    switch (kinds) {
    case 0: {
        const Vec3 p = a.corner0();
        return measured(p, b.corner0() - p, 1, 1);
    }
    case 1:
        return turned(measure_edge_vertex(b.corner0(), b.corner1(), a.corner0()));
    case 2:
        return turned(measure_face_vertex(b.triangle(), a.corner0()));
    case 3:
        return measure_edge_vertex(a.corner0(), a.corner1(), b.corner0());
    case 4:
        return measure_edge_edge(a.corner0(), a.corner1(), b.corner0(), b.corner1());
    case 5:
        return turned(measure_face_edge(b.triangle(), a.corner0(), a.corner1()));
    case 6:
        return measure_face_vertex(a.triangle(), b.corner0());
    default:
        return measure_face_edge(a.triangle(), b.corner0(), b.corner1());
    }
}

} // namespace

WalkState walk(const PolytopePair& pair, const HullFeature& a, const HullFeature& b,
               double rounding) {
    Placed side_a{pair.a, a}, side_b{pair.b, b};
    Measured now = measure(side_a, side_b);
    WalkState state;
    state.steps = 1;
    const auto settle = [&] {
        side_a.feature = side_a.part(now.a);
        side_b.feature = side_b.part(now.b);
    };
    settle();
    const auto improves = [&](const HullFeature& next_a, const HullFeature& next_b) {
        const Placed grown_a{pair.a, next_a}, grown_b{pair.b, next_b};
        const Measured next = measure(grown_a, grown_b);
        ++state.steps;
        if (!(next.distance_sq < now.distance_sq))
            return false;
        now = next;
        side_a.feature = next_a, side_b.feature = next_b;
        settle();
        return true;
    };
    for (;;) {
        if (!(now.distance_sq > rounding * rounding)) {
            state.end = WalkEnd::meeting;
            break;
        }
        const Placed::Growth grown_a = side_a.growth(now.gap), grown_b = side_b.growth(-now.gap);
        // No point is nearer than the distance less the sum of the excesses over the distance.
        const double excess = std::max(grown_a.excess, 0.0) + std::max(grown_b.excess, 0.0);
        if (excess * excess <= rounding * rounding * now.distance_sq)
            break;
        const bool face_a = side_a.feature.kind == Feature::face,
                   face_b = side_b.feature.kind == Feature::face;
        const bool a_can = grown_a.excess > 0 && !face_a, b_can = grown_b.excess > 0 && !face_b;
        const bool a_first = a_can && (!b_can || grown_a.excess >= grown_b.excess);
        if (a_can && a_first && improves(grown_a.feature, side_b.feature))
            continue;
        if (b_can && improves(side_a.feature, grown_b.feature))
            continue;
        if (a_can && !a_first && improves(grown_a.feature, side_b.feature))
            continue;
        state.end = WalkEnd::stuck;
        break;
    }
    state.a = side_a.feature, state.b = side_b.feature;
    state.point_a = now.point_a, state.gap = now.gap, state.distance_sq = now.distance_sq;
    return state;
}

} // namespace abut
