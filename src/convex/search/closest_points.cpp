#include "convex/search/closest_points.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace abut {

HullFeature spanned_feature(const Polytope& polytope, const Vec3& n,
                            std::span<const std::uint32_t> vertices) {
    HullFeature feature = vertex_feature(vertices[0]);
    if (vertices.size() == 1)
        return feature;
    const HullVertex& v = polytope.vertices[vertices[0]];
    const auto below = [&](std::uint32_t edge) { return dot(n, v.at - polytope.to(edge)); };
    for (std::uint32_t e = v.first_edge; e < v.first_edge + v.degree; ++e)
        if (vertices.size() == 2 && polytope.target(e) == vertices[1])
            return {vertices[0], e, Feature::edge};
    feature = {vertices[0], v.first_edge, Feature::face};
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t e = v.first_edge; e < v.first_edge + v.degree; ++e)
        if (const double drop = std::max(below(e), below(polytope.after(v, e))); drop < least)
            least = drop, feature.edge = e;
    return feature;
}

std::vector<std::uint32_t> vertices_of(const DifferenceSimplex& simplex,
                                       std::uint32_t VertexPair::*side) {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t i = 0; i < simplex.count; ++i)
        if (const std::uint32_t v = simplex.corners[i].*side;
            std::find(vertices.begin(), vertices.end(), v) == vertices.end())
            vertices.push_back(v);
    return vertices;
}

namespace {

/// Measured feature pairs after which a restart from the tables of normals may be shorter.
constexpr std::uint32_t kLeap = 8;

/// Moves to the vertices that face each other along the gap, if they are nearer. If they have
/// passed each other along it, the polytopes are likely to meet, and the walk is set to stuck: GJK
/// finds that sooner.
void leap(const PolytopePair& pair, WalkState& at) {
    const std::uint32_t a = pair.a.polytope->starts.vertex(pair.a.pulled_back(at.gap)),
                        b = pair.b.polytope->starts.vertex(pair.b.pulled_back(-at.gap));
    const Vec3 gap = pair.b.vertex(b) - pair.a.vertex(a);
    if (dot(gap, at.gap) < 0)
        at.end = WalkEnd::stuck;
    else if (length_sq(gap) < at.distance_sq)
        at.a = vertex_feature(a), at.b = vertex_feature(b);
}

} // namespace

void find_closest_points_from_simplex(const PolytopePair& pair, double rounding,
                                      ClosestPointSearch& search) {
    const GjkState found = gjk(pair, *search.simplex, rounding);
    search.simplices += found.steps;
    search.simplex = found.simplex;
    WalkState& at = search.at;
    if (!found.meeting) {
        // A walk from the vertices of the heaviest corner finds the closest features, and the
        // digits of the distance that weights lose.
        const auto& weights = found.simplex.weights;
        const auto* heaviest =
            std::max_element(weights.begin(), weights.begin() + found.simplex.count);
        const auto& nearest =
            found.simplex.corners[static_cast<std::size_t>(heaviest - weights.begin())];
        at.a = vertex_feature(nearest.a), at.b = vertex_feature(nearest.b);
        walk(pair, rounding, kNoLimit, at);
        if (at.end != WalkEnd::stuck)
            return;
        at.a = spanned_feature(*pair.a.polytope, pair.a.pulled_back(found.gap),
                               vertices_of(found.simplex, &VertexPair::a));
        at.b = spanned_feature(*pair.b.polytope, pair.b.pulled_back(-found.gap),
                               vertices_of(found.simplex, &VertexPair::b));
    }
    at.point_a = found.point_a, at.gap = found.gap;
    at.distance_sq = found.distance_sq, at.excess = found.excess;
    at.end = found.meeting ? WalkEnd::meeting : WalkEnd::closest;
    at.proven = found.meeting && found.proven;
    at.of_features = false;
}

void find_closest_points(const PolytopePair& pair, double rounding, ClosestPointSearch& search) {
    walk(pair, rounding, kLeap, search.at);
    if (search.at.end == WalkEnd::limit) {
        leap(pair, search.at);
        if (search.at.end == WalkEnd::limit)
            walk(pair, rounding, kNoLimit, search.at);
    }
    if (search.at.end != WalkEnd::stuck)
        return;
    search.simplex.emplace();
    search.simplex->corners[0] = {search.at.a.vertex, search.at.b.vertex};
    search.simplex->count = 1;
    find_closest_points_from_simplex(pair, rounding, search);
}

} // namespace abut
