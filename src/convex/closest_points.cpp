#include "convex/closest_points.h"

#include <algorithm>
#include <span>

namespace abut {

namespace {

void take(ClosestState& state, const WalkState& walked) {
    state.a = walked.a, state.b = walked.b;
    state.point_a = walked.point_a, state.gap = walked.gap;
    state.distance_sq = walked.distance_sq;
    state.meeting = walked.end == WalkEnd::meeting;
}

/// The feature whose corners, or some of them, the vertices are. In a face of many corners these
/// need not be neighbours: then the triangle next to the first that is flattest as seen along n.
HullFeature spanned_feature(const Polytope& polytope, const Vec3& n,
                            std::span<const std::uint32_t> vertices) {
    HullFeature feature = vertex_feature(vertices[0]);
    if (vertices.size() == 1)
        return feature;
    const HullVertex& v = polytope.vertices[vertices[0]];
    const auto below = [&](std::uint32_t edge) { return dot(n, v.at - polytope.edges[edge].to); };
    for (std::uint32_t e = v.first_edge; e < v.first_edge + v.degree; ++e)
        if (vertices.size() == 2 && polytope.edges[e].target == vertices[1])
            return {vertices[0], e, Feature::edge};
    feature = {vertices[0], v.first_edge, Feature::face};
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t e = v.first_edge; e < v.first_edge + v.degree; ++e)
        if (const double drop = std::max(below(e), below(polytope.after(v, e))); drop < least)
            least = drop, feature.edge = e;
    return feature;
}

/// The distinct vertices of one side of a simplex.
std::vector<std::uint32_t> vertices_of(const DifferenceSimplex& simplex,
                                       std::uint32_t VertexPair::*side) {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t i = 0; i < simplex.count; ++i)
        if (const std::uint32_t v = simplex.corners[i].*side;
            std::find(vertices.begin(), vertices.end(), v) == vertices.end())
            vertices.push_back(v);
    return vertices;
}

} // namespace

ClosestState closest_points(const PolytopePair& pair, const DifferenceSimplex& start,
                            double rounding) {
    const SimplexState found = search_simplex(pair, start, rounding);
    ClosestState state;
    state.simplices = found.steps;
    state.simplex = found.simplex;
    state.point_a = found.point_a, state.gap = found.gap;
    state.distance_sq = found.distance_sq;
    state.meeting = found.meeting;
    if (found.meeting)
        return state;
    // The closest features, and the digits that weights lose, come from a walk that begins at them.
    const auto& weights = found.simplex.weights;
    const auto heaviest = static_cast<std::size_t>(
        std::max_element(weights.begin(), weights.begin() + found.simplex.count) - weights.begin());
    const VertexPair& nearest = found.simplex.corners[heaviest];
    const WalkState walked =
        walk(pair, vertex_feature(nearest.a), vertex_feature(nearest.b), rounding);
    state.feature_pairs = walked.steps;
    if (walked.end != WalkEnd::stuck) {
        take(state, walked);
        return state;
    }
    state.a = spanned_feature(*pair.a.polytope, pair.a.map.pulled_back(found.gap),
                              vertices_of(found.simplex, &VertexPair::a));
    state.b = spanned_feature(*pair.b.polytope, pair.b.map.pulled_back(-found.gap),
                              vertices_of(found.simplex, &VertexPair::b));
    return state;
}

ClosestState closest_points(const PolytopePair& pair, const HullFeature& a, const HullFeature& b,
                            double rounding) {
    const WalkState walked = walk(pair, a, b, rounding);
    if (walked.end == WalkEnd::stuck) {
        ClosestState state =
            closest_points(pair, {{{{walked.a.vertex, walked.b.vertex}}}, {}, 1}, rounding);
        state.feature_pairs += walked.steps;
        return state;
    }
    ClosestState state;
    take(state, walked);
    state.feature_pairs = walked.steps;
    return state;
}

} // namespace abut
