#include "convex/convex_query.h"

namespace abut {

Vec3 between_middles(const ConvexData& a, const ConvexData& b, const PolytopePair& pair) {
    return pair.b.place(b.ball.middle) - pair.a.place(a.ball.middle);
}

VertexPair facing_vertices(const PolytopePair& pair, const Vec3& direction) {
    return {pair.a.polytope->starts.vertex(pair.a.pulled_back(direction)),
            pair.b.polytope->starts.vertex(pair.b.pulled_back(-direction))};
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
