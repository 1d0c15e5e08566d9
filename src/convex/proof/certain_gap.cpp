#include "convex/proof/certain_gap.h"

#include "convex/proof/exact_closest_points.h"
#include "geometry/point_triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

struct FeatureCorners {
    std::array<std::uint32_t, 3> vertices{};
    std::size_t count = 1;
};

FeatureCorners corners_of(const Polytope& p, const HullFeature& f) {
    FeatureCorners corners;
    corners.vertices[0] = f.vertex;
    if (f.kind != Feature::vertex)
        corners.vertices[corners.count++] = p.target(f.edge);
    if (f.kind == Feature::face)
        corners.vertices[corners.count++] = p.target(p.after(p.vertices[f.vertex], f.edge));
    return corners;
}

std::array<Vec3, 3> placed(const PlacedPolytope& side, const FeatureCorners& corners) {
    std::array<Vec3, 3> points{};
    for (std::size_t i = 0; i < corners.count; ++i)
        points[i] = side.vertex(corners.vertices[i]);
    return points;
}

/// The direction perpendicular to both features, as far as they have extent. Its relative error is
/// a few roundings, however short the gap. Zero where there is none.
Vec3 across(const PolytopePair& pair, const WalkState& at) {
    const FeatureCorners a = corners_of(*pair.a.polytope, at.a),
                         b = corners_of(*pair.b.polytope, at.b);
    const std::array<Vec3, 3> p = placed(pair.a, a), q = placed(pair.b, b);
    Vec3 n = at.gap;
    const auto clear = [&](const Vec3& u) {
        for (int i = 0; i < 2; ++i)
            n = n - (dot(n, u) / length_sq(u)) * u;
    };
    if (a.count == 3)
        n = cross(p[1] - p[0], p[2] - p[0]);
    else if (b.count == 3)
        n = cross(q[1] - q[0], q[2] - q[0]);
    else if (a.count == 2 && b.count == 2)
        n = cross(p[1] - p[0], q[1] - q[0]);
    else if (a.count == 2)
        clear(p[1] - p[0]);
    else if (b.count == 2)
        clear(q[1] - q[0]);
    return dot(n, at.gap) < 0 ? -n : n;
}

/// Returns whether a segment certainly passes through the inside of a triangle, if each corner is
/// off by at most `error`.
bool pierces_surely(const std::array<Vec3, 3>& t, const Vec3& q0, const Vec3& q1, double error) {
    const Vec3 e0 = t[0] - q0, e1 = t[1] - q0, e2 = t[2] - q0, d = q1 - q0;
    const double size_sq = std::max({length_sq(e0), length_sq(e1), length_sq(e2), length_sq(d)});
    const Vec3 c01 = cross(e0, e1), c12 = cross(e1, e2), c20 = cross(e2, e0);
    const double s0 = dot(d, c12), s1 = dot(d, c20), s2 = dot(d, c01);
    const double before = dot(e0, c12), after = before - (s0 + s1 + s2);
    // A determinant of three differences, each off by at most 2 e: off by 8 e size^2, and by its
    // rounding.
    const double doubt = 64 * error * size_sq;
    const bool around =
        (s0 > doubt && s1 > doubt && s2 > doubt) || (s0 < -doubt && s1 < -doubt && s2 < -doubt);
    return size_sq > 0x1p-600 && around &&
           ((before > doubt && after < -doubt) || (before < -doubt && after > doubt));
}

/// Corners of the difference, from the simplex or the features that a search ended with.
DifferenceSimplex start_from(const PolytopePair& pair, const ClosestPointSearch& search) {
    if (search.simplex && search.simplex->count > 0)
        return *search.simplex;
    const FeatureCorners a = corners_of(*pair.a.polytope, search.at.a),
                         b = corners_of(*pair.b.polytope, search.at.b);
    DifferenceSimplex start;
    for (std::size_t i = 0; i < std::max(a.count, b.count); ++i)
        add_if_new({a.vertices[std::min(i, a.count - 1)], b.vertices[std::min(i, b.count - 1)]},
                   start);
    return start;
}

HullFeature nearest_feature(const ConvexData& body, const Transform& world, const Vec3& point) {
    const Polytope& p = body.levels[0].polytope;
    if (body.triangles.empty())
        return {0, 0, p.vertices.size() == 1 ? Feature::vertex : Feature::edge};
    NearestOnTriangle nearest;
    nearest.distance_sq = std::numeric_limits<double>::infinity();
    const IndexTriangle* triangle = nullptr;
    for (const IndexTriangle& t : body.triangles) {
        const NearestOnTriangle n = nearest_on_triangle(point, {apply(world, body.vertices[t[0]]),
                                                                apply(world, body.vertices[t[1]]),
                                                                apply(world, body.vertices[t[2]])});
        if (triangle == nullptr || n.distance_sq < nearest.distance_sq)
            nearest = n, triangle = &t;
    }
    const std::uint32_t from = (*triangle)[nearest.dimension == 2 ? 0 : nearest.index],
                        to = (*triangle)[nearest.dimension == 2 ? 1 : (nearest.index + 1) % 3];
    if (nearest.dimension == 0)
        return vertex_feature(from);
    const HullVertex& v = p.vertices[from];
    std::uint32_t edge = v.first_edge;
    while (p.target(edge) != to)
        ++edge;
    return {from, edge, nearest.dimension == 1 ? Feature::edge : Feature::face};
}

/// The feature that has these corners; if there is none, the one nearest to the point.
HullFeature feature_of(const ConvexData& body, const Transform& world,
                       std::span<const std::uint32_t> corners, const Vec3& point) {
    const Polytope& p = body.levels[0].polytope;
    const auto is_known = [&](std::uint32_t v) { return v < p.vertices.size(); };
    if (corners.size() <= 2 && std::all_of(corners.begin(), corners.end(), is_known)) {
        if (corners.size() == 1)
            return vertex_feature(corners[0]);
        const HullVertex& v = p.vertices[corners[0]];
        for (std::uint32_t e = v.first_edge; e < v.first_edge + v.degree; ++e)
            if (p.target(e) == corners[1])
                return {corners[0], e, Feature::edge};
    }
    return nearest_feature(body, world, point);
}

/// The corners of a simplex whose vertices the polytopes have.
DifferenceSimplex known_part(const PolytopePair& pair, const DifferenceSimplex& simplex) {
    DifferenceSimplex known;
    for (std::uint32_t i = 0; i < simplex.count; ++i)
        if (simplex.corners[i].a < pair.a.polytope->vertices.size() &&
            simplex.corners[i].b < pair.b.polytope->vertices.size())
            known.corners[known.count++] = simplex.corners[i];
    return known;
}

/// Measures the features that the integers have found in the pair's frame, where they lose no digits
/// far from the world's origin. The search is unchanged unless all vertices prove the distance.
void measure_in_frame(const PlacedConvexPair& bodies, const PolytopePair& pair, double rounding,
                      WalkState& at) {
    WalkState measured = at;
    walk(pair, rounding, kNoLimit, measured);
    if (measured.end != WalkEnd::closest)
        return;
    const DistanceBounds bounds =
        distance_bounds(pair, bodies.a.left_out, bodies.b.left_out, rounding, measured);
    if (bounds.in_frame > 0 &&
        is_tight_in_frame(bounds, std::sqrt(measured.distance_sq), rounding)) {
        measured.proven = true;
        at = measured;
    }
}

CertainDistance decide(const PlacedConvexPair& bodies, const PolytopePair& pair, double rounding,
                       ClosestPointSearch& search) {
    const PlacedPoints points = bodies.points();
    require_finite(points);
    const ExactClosestPoints found =
        exact_closest_points(points, IntegerGrid(points), start_from(pair, search));
    search.simplices += found.steps;
    WalkState& at = search.at;
    const auto& m = bodies.world_from_a.m;
    at.point_a = found.point_a - Vec3{m[9], m[10], m[11]};
    at.gap = found.gap;
    at.distance_sq = found.distance * found.distance;
    at.excess = 0;
    at.proven = true;
    at.of_features = false;
    at.end = found.meeting ? WalkEnd::meeting : WalkEnd::closest;
    search.simplex.reset();
    if (found.meeting) {
        // The next query with this warm start begins with this simplex.
        const DifferenceSimplex known = known_part(pair, found.simplex);
        if (known.count > 0)
            search.simplex = known;
        return {};
    }
    at.a = feature_of(bodies.a, bodies.world_from_a, vertices_of(found.simplex, &VertexPair::a),
                      found.point_a);
    at.b = feature_of(bodies.b, bodies.world_from_b, vertices_of(found.simplex, &VertexPair::b),
                      found.point_a + found.gap);
    measure_in_frame(bodies, pair, rounding, at);
    const double distance = at.of_features ? std::sqrt(at.distance_sq) : found.distance;
    return {distance, std::min(found.at_least, distance)};
}

} // namespace

double highest(const PlacedPolytope& side, std::span<const Vec3> left_out, const Vec3& direction) {
    const Vec3 n = side.pulled_back(direction);
    double most = -std::numeric_limits<double>::infinity();
    for (const HullVertex& v : side.polytope->vertices)
        most = std::max(most, dot(n, v.at));
    for (const Vec3& p : left_out)
        most = std::max(most, dot(n, p));
    return most + dot(direction, side.offset);
}

DistanceBounds distance_bounds(const PolytopePair& pair, std::span<const Vec3> left_out_a,
                               std::span<const Vec3> left_out_b, double rounding,
                               const WalkState& at) {
    double room = -std::numeric_limits<double>::infinity();
    for (const Vec3& n : {at.gap, across(pair, at)}) {
        const double size = length(n);
        if (!(size > 0x1p-300 && size < 0x1p300))
            continue;
        const double along = -highest(pair.b, left_out_b, -n) - highest(pair.a, left_out_a, n);
        room = std::max(room, along / size);
    }
    // Two roundings for the heights, one for their quotient, one for the positions.
    return {room - 4 * rounding, room - 4 * (rounding + world_rounding(pair))};
}

bool surely_meet(const PolytopePair& pair, double rounding, const WalkState& at) {
    if (at.end != WalkEnd::meeting || at.distance_sq != 0)
        return false;
    const FeatureCorners a = corners_of(*pair.a.polytope, at.a),
                         b = corners_of(*pair.b.polytope, at.b);
    const std::array<Vec3, 3> p = placed(pair.a, a), q = placed(pair.b, b);
    const double error = rounding + world_rounding(pair);
    if (a.count == 3 && b.count == 2)
        return pierces_surely(p, q[0], q[1], error);
    return a.count == 2 && b.count == 3 && pierces_surely(q, p[0], p[1], error);
}

CertainDistance settle_gap(const PlacedConvexPair& bodies, double rounding,
                           ClosestPointSearch& search) {
    const PolytopePair pair = bodies.pair();
    WalkState& at = search.at;
    if (at.end == WalkEnd::closest) {
        const DistanceBounds bounds =
            distance_bounds(pair, bodies.a.left_out, bodies.b.left_out, rounding, at);
        const double distance = std::sqrt(at.distance_sq);
        if (is_tight(bounds, distance, rounding)) {
            at.proven = true;
            return {distance, std::min(bounds.certain, distance)};
        }
    }
    return decide(bodies, pair, rounding, search);
}

} // namespace abut
