#include "convex/convex_query.h"

namespace abut {

Vec3 between_middles(const ConvexData& a, const ConvexData& b, const PolytopePair& pair) {
    return pair.b.place(b.ball.middle) - pair.a.place(a.ball.middle);
}

VertexPair facing_vertices(const PolytopePair& pair, const Vec3& direction) {
    return {pair.a.polytope->starts.vertex(pair.a.pulled_back(direction)),
            pair.b.polytope->starts.vertex(pair.b.pulled_back(-direction))};
}

namespace {

/// Sets a feature to a remembered one, if the polytope has it.
void recall(const Polytope& polytope, std::uint32_t vertex, std::uint32_t edge, std::uint32_t kind,
            HullFeature& f) {
    if (vertex >= polytope.vertices.size())
        return;
    const HullVertex& v = polytope.vertices[vertex];
    f.vertex = vertex;
    f.edge = edge;
    f.kind = edge - v.first_edge < v.degree ? static_cast<Feature>(kind) : Feature::vertex;
}

} // namespace

void recall(const PolytopePair& pair, const ConvexWarmStart& last, HullFeature& a, HullFeature& b) {
    const auto& pairs = last.pairs;
    recall(*pair.a.polytope, pairs[0].a, pairs[1].a, pairs[2].a, a);
    recall(*pair.b.polytope, pairs[0].b, pairs[1].b, pairs[2].b, b);
}

void remember(const HullFeature& a, const HullFeature& b, ConvexWarmStart& warm_start) {
    auto& pairs = warm_start.pairs;
    warm_start.kind = ConvexWarmStart::Kind::features;
    pairs[0] = {a.vertex, b.vertex};
    pairs[1] = {a.edge, b.edge};
    pairs[2] = {static_cast<std::uint32_t>(a.kind), static_cast<std::uint32_t>(b.kind)};
}

DifferenceSimplex recalled_simplex(const PolytopePair& pair, const ConvexWarmStart& warm_start) {
    DifferenceSimplex simplex;
    for (const VertexPair& last : warm_start.pairs)
        add_if_new(recalled(pair, last), simplex);
    return simplex;
}

void remember(const DifferenceSimplex& simplex, ConvexWarmStart& warm_start) {
    warm_start.kind = ConvexWarmStart::Kind::simplex;
    for (std::size_t i = 0; i < 4; ++i)
        warm_start.pairs[i] = simplex.corners[i < simplex.count ? i : 0];
}

} // namespace abut
