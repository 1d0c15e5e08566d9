#include <abut/convex.h>

#include "convex/body/convex_data.h"
#include "convex/convex_query.h"
#include "convex/proof/certain_gap.h"
#include "convex/proof/exact_closest_points.h"
#include "convex/proof/exact_depth.h"
#include "convex/search/epa.h"
#include "convex/search/shallow_depth.h"
#include "math/vector.h"

#include <cmath>
#include <optional>

namespace abut {

namespace {

/// Four corners around the origin: one towards the boundary that is nearest judged by the centres,
/// three on the opposite side. They hold the origin most often; otherwise GJK continues from them.
DifferenceSimplex simplex_around(const PolytopePair& pair, const Vec3& between) {
    const Vec3 u = length_sq(between) > 0 ? normalized_or_zero(-between) : Vec3{1, 0, 0};
    const Vec3 v = perpendicular(u), w = cross(u, v);
    const double cosine = -0.5, sine = std::sqrt(0.75); // a third of a turn
    DifferenceSimplex simplex;
    for (const Vec3& outward : {u, v, cosine * v + sine * w, cosine * v - sine * w})
        add_if_new(facing_vertices(pair, -outward), simplex);
    return simplex;
}

/// What a query derives from its bodies.
struct Bodies {
    const ConvexData &a, &b;
    const PlacedConvexPair placed;
    const PolytopePair pair;
    double rounding;
};

/// Returns whether a search has proven that the bodies are apart.
bool surely_apart(const Bodies& bodies, const ClosestPointSearch& search) {
    const double doubt =
        9 * bodies.rounding + world_rounding(bodies.pair) + bodies.placed.outside();
    if (search.at.end != WalkEnd::closest || !(search.at.distance_sq > 4 * doubt * doubt))
        return false;
    return (search.at.proven && is_measurable(search.at.distance_sq, doubt)) ||
           is_proven_across(bodies.pair, bodies.rounding, search.at);
}

/// Searches from a simplex that holds the origin; none if the bodies are proven apart.
std::optional<NearestBoundary> begin(const Bodies& bodies, ConvexWarmStart* warm_start,
                                     ConvexCounters& counters) {
    const PolytopePair& pair = bodies.pair;
    ClosestPointSearch search;
    search.simplex = warm_start != nullptr && has_simplex(*warm_start)
                         ? recalled_simplex(pair, *warm_start)
                         : simplex_around(pair, between_middles(bodies.a, bodies.b, pair));
    find_closest_points_from_simplex(pair, bodies.rounding, search);
    if (search.at.end != WalkEnd::meeting || !search.simplex) {
        if (surely_apart(bodies, search) ||
            settle_gap(bodies.placed, bodies.rounding, search).distance > 0) {
            counters.simplices = search.simplices;
            return std::nullopt;
        }
    }
    counters.simplices = search.simplices;
    if (!search.simplex)
        return NearestBoundary{};
    if (warm_start != nullptr)
        remember(*search.simplex, *warm_start);
    return expand_simplex(pair, bodies.rounding, *search.simplex,
                          warm_start != nullptr ? &warm_start->deepest : nullptr);
}

/// Bodies whose facing vertices have passed each other by at most this share of the way between
/// their middles overlap little.
constexpr double kShallow = 0.4;

/// The ball of the difference that the bodies' inner balls make.
DifferenceBall ball_of(const Bodies& bodies, const Transform& world_from_a,
                       const Transform& world_from_b) {
    const double radius = stretch_of(world_from_a).least * bodies.a.ball.radius +
                          stretch_of(world_from_b).least * bodies.b.ball.radius;
    return {between_middles(bodies.a, bodies.b, bodies.pair),
            radius - 8 * (bodies.rounding + world_rounding(bodies.pair))};
}

/// Walks to the nearest face of the difference; none if that does not prove the depth.
std::optional<NearestBoundary> begin_shallow(const Bodies& bodies, const DifferenceBall& ball,
                                             ConvexWarmStart* warm_start,
                                             ConvexCounters& counters) {
    const PolytopePair& pair = bodies.pair;
    const double way = length(ball.middle);
    if (!(ball.radius > 0 && way > 0x1p20 * bodies.rounding &&
          bodies.a.outside + bodies.b.outside == 0))
        return std::nullopt;
    ShallowSearch search;
    NearestBoundary nearest;
    if (warm_start != nullptr && warm_start->kind == ConvexWarmStart::Kind::features) {
        recall(pair, *warm_start, search.a, search.b);
        if (static_cast<int>(search.a.kind) + static_cast<int>(search.b.kind) == 2)
            find_shallow_depth_again(pair, ball, bodies.rounding, search, nearest);
    }
    if (!search.is_face) {
        const Vec3 outward = (-1 / way) * ball.middle;
        const VertexPair start = facing_vertices(pair, -outward);
        const double height = dot(outward, pair.b.vertex(start.b) - pair.a.vertex(start.a));
        if (height > kShallow * way)
            return std::nullopt;
        search.a = vertex_feature(start.a), search.b = vertex_feature(start.b);
        find_shallow_depth(pair, ball, bodies.rounding, outward, height, search, nearest);
    }
    counters.feature_pairs += search.feature_pairs;
    if (!search.is_face)
        return std::nullopt;
    if (warm_start != nullptr) {
        remember(search.a, search.b, *warm_start);
        warm_start->deepest.corners.clear(), warm_start->deepest.faces.clear();
    }
    if (nearest.is_inside_proven)
        return nearest;
    // The face, and a corner far behind it.
    DifferenceSimplex simplex;
    for (const VertexPair& corner : nearest.corners)
        add_if_new(corner, simplex);
    add_if_new(facing_vertices(pair, nearest.normal), simplex);
    return expand_simplex(pair, bodies.rounding, simplex, nullptr);
}

/// Returns whether both bounds are proven and equal to rounding. The upper bound is proven by
/// looking at all vertices if the search did not prove it.
bool is_proven(const Bodies& bodies, const NearestBoundary& nearest) {
    // `at_least` is less by four roundings of the world's positions, which say nothing about how
    // near the two bounds are.
    const double width = nearest.depth - nearest.at_least - 4 * world_rounding(bodies.pair);
    if (!(nearest.is_inside_proven && width <= 12 * bodies.rounding))
        return false;
    if (nearest.is_depth_proven)
        return true;
    const double reach = highest(bodies.pair.b, bodies.b.left_out, nearest.normal) +
                         highest(bodies.pair.a, bodies.a.left_out, -nearest.normal);
    return reach <= nearest.depth + 4 * bodies.rounding;
}

/// Computes the depth in integers; none if the bodies do not meet.
std::optional<NearestBoundary> decide_depth(const Bodies& bodies, const NearestBoundary& nearest,
                                            ConvexWarmStart* warm_start, Vec3& point_a,
                                            Vec3& point_b) {
    if (warm_start != nullptr)
        warm_start->deepest.corners.clear(), warm_start->deepest.faces.clear();
    const PlacedPoints points = bodies.placed.points();
    require_finite(points);
    const IntegerGrid grid(points);
    DifferenceSimplex start;
    for (const VertexPair& corner : nearest.corners)
        add_if_new(corner, start);
    const ExactClosestPoints closest = exact_closest_points(points, grid, start);
    if (!closest.meeting)
        return std::nullopt;
    const NearestBoundary decided = exact_depth(points, grid, closest.simplex);
    for (std::size_t i = 0; i < 3; ++i) {
        point_a = point_a + decided.weights[i] * (points.a[decided.corners[i].a] - points.a[0]);
        point_b = point_b + decided.weights[i] * (points.b[decided.corners[i].b] - points.b[0]);
    }
    point_a = points.a[0] + point_a, point_b = points.b[0] + point_b;
    return decided;
}

/// Replaces a result that is not proven.
[[gnu::noinline, gnu::cold]] void settle_depth(const Bodies& bodies, NearestBoundary nearest,
                                               ConvexWarmStart* warm_start, ConvexDepth& result) {
    const ConvexCounters counters = result.counters;
    result = {};
    result.counters = counters;
    const std::optional<NearestBoundary> decided =
        decide_depth(bodies, nearest, warm_start, result.point_a, result.point_b);
    if (!decided) {
        result.point_a = result.point_b = {};
        return;
    }
    result.meet = true;
    result.counters.simplices += decided->steps;
    result.depth = decided->depth, result.at_least = decided->at_least;
    result.direction = -decided->normal;
}

/// Replaces witness points that are not a depth apart along the direction: where rounding decides
/// which of nearly coplanar faces of the difference is the nearest, the origin's foot may lie
/// outside of it. After the motion and slightly more, the closest points are as far apart as that.
[[gnu::noinline, gnu::cold]] void replace_witness(const Convex& a, const Transform& world_from_a,
                                                  const Convex& b, const Transform& world_from_b,
                                                  double slight, ConvexDepth& result) {
    const Vec3 way = (result.depth + slight) * result.direction;
    Transform moved = world_from_b;
    moved.m[9] += way.x, moved.m[10] += way.y, moved.m[11] += way.z;
    const ConvexGap parted = distance(a, world_from_a, b, moved);
    result.point_a = parted.point_a, result.point_b = parted.point_b - way;
}

} // namespace

ConvexDepth penetration(const Convex& a, const Transform& world_from_a, const Convex& b,
                        const Transform& world_from_b, const ConvexPenetrationOptions& options) {
    ConvexWarmStart* const warm_start = options.warm_start;
    const double rounding = rounding_of(a.data(), world_from_a, b.data(), world_from_b);
    const PlacedConvexPair placed{a.data(), b.data(), world_from_a, world_from_b};
    const Bodies bodies{a.data(), b.data(), placed, placed.pair(), rounding};
    const PolytopePair& pair = bodies.pair;
    ConvexDepth result;
    // Continues from the polytope that proved the last depth, if it still holds the origin.
    std::optional<NearestBoundary> nearest;
    if (warm_start != nullptr && !warm_start->deepest.faces.empty())
        nearest = expand_again(pair, rounding, warm_start->deepest);
    if (!nearest)
        nearest = begin_shallow(bodies, ball_of(bodies, world_from_a, world_from_b), warm_start,
                                result.counters);
    if (!nearest)
        nearest = begin(bodies, warm_start, result.counters);
    if (!nearest)
        return result;
    result.meet = true;
    result.counters.simplices += nearest->steps;
    result.depth = nearest->depth, result.at_least = nearest->at_least;
    // The difference b - a reaches `depth` along the normal, so b moves back by as much.
    result.direction = -nearest->normal;
    for (std::size_t i = 0; i < 3; ++i) {
        const double weight = nearest->weights[i];
        result.point_a = result.point_a + weight * pair.a.vertex(nearest->corners[i].a);
        result.point_b = result.point_b + weight * pair.b.vertex(nearest->corners[i].b);
    }
    const Vec3 origin{world_from_a.m[9], world_from_a.m[10], world_from_a.m[11]};
    result.point_a = origin + result.point_a;
    result.point_b = origin + result.point_b;
    if (!is_proven(bodies, *nearest))
        settle_depth(bodies, *nearest, warm_start, result);
    // A share of the size that is far above rounding, and one that is far above that.
    const double off = 0x1p12 * (rounding + world_rounding(pair)), slight = 0x1p30 * rounding;
    if (result.meet &&
        length_sq(result.point_b - result.point_a + result.depth * result.direction) > off * off)
        replace_witness(a, world_from_a, b, world_from_b, slight, result);
    return result;
}

} // namespace abut
