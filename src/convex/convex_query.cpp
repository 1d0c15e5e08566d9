#include "convex/convex_query.h"

#include "math/transform.h"

#include <algorithm>
#include <cmath>

namespace abut {

double rounding_of(const ConvexData& a, const Transform& world_from_a, const ConvexData& b,
                   const Transform& world_from_b) {
    double offset = 0;
    for (std::size_t i = 9; i < 12; ++i)
        offset += std::abs(world_from_b.m[i] - world_from_a.m[i]);
    const double rounding = 0x1p-51 * (sum_of_sizes(world_from_a) * a.reach +
                                       sum_of_sizes(world_from_b) * b.reach + offset);
    if (!std::isfinite(rounding)) {
        require_finite(world_from_a, "transform of a");
        require_finite(world_from_b, "transform of b");
    }
    return rounding;
}

Vec3 between_middles(const ConvexData& a, const ConvexData& b, const PolytopePair& pair) {
    return pair.b.place(b.ball.middle) - pair.a.place(a.ball.middle);
}

VertexPair facing_vertices(const PolytopePair& pair, const Vec3& direction) {
    return {pair.a.polytope->starts.vertex(pair.a.pulled_back(direction)),
            pair.b.polytope->starts.vertex(pair.b.pulled_back(-direction))};
}

DifferenceSimplex first_simplex(const ConvexData& a, const ConvexData& b, const PolytopePair& pair,
                                const ConvexWorkspace* workspace) {
    DifferenceSimplex simplex;
    if (workspace == nullptr || workspace->kind != ConvexWorkspace::Kind::simplex) {
        simplex.corners[0] = facing_vertices(pair, between_middles(a, b, pair));
        simplex.count = 1;
        return simplex;
    }
    for (const VertexPair& last : workspace->pairs) {
        const VertexPair corner = recalled(pair, last);
        auto* const end = simplex.corners.begin() + simplex.count;
        if (std::find(simplex.corners.begin(), end, corner) == end)
            simplex.corners[simplex.count++] = corner;
    }
    return simplex;
}

void remember(const DifferenceSimplex& simplex, ConvexWorkspace& workspace) {
    workspace.kind = ConvexWorkspace::Kind::simplex;
    for (std::size_t i = 0; i < 4; ++i)
        workspace.pairs[i] = simplex.corners[i < simplex.count ? i : 0];
}

} // namespace abut
