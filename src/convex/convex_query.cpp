#include "convex/convex_query.h"

#include "math/transform.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

Roundings roundings_of(const ConvexData& a, const Transform& world_from_a, const ConvexData& b,
                       const Transform& world_from_b) {
    const auto &m = world_from_a.m, &n = world_from_b.m;
    // Two sums, that two lanes may do.
    std::array<double, 2> sums{};
    for (std::size_t i = 0; i < 8; i += 2)
        for (std::size_t k = 0; k < 2; ++k)
            sums[k] += std::abs(m[i + k]) * a.reach + std::abs(n[i + k]) * b.reach;
    const double last = std::abs(m[8]) * a.reach + std::abs(n[8]) * b.reach;
    const double offset = sum_of_sizes(Vec3{n[9] - m[9], n[10] - m[10], n[11] - m[11]});
    const double of_pair = 0x1p-51 * (sums[0] + sums[1] + last + offset);
    // The other translation is no longer than this one and the offset, which `of_pair` has.
    const Roundings roundings{of_pair,
                              2 * of_pair + 0x1p-50 * sum_of_sizes(Vec3{m[9], m[10], m[11]})};
    if (!std::isfinite(roundings.all)) {
        require_finite(world_from_a, "transform of a");
        require_finite(world_from_b, "transform of b");
    }
    return roundings;
}

Vec3 between_middles(const ConvexData& a, const ConvexData& b, const PolytopePair& pair) {
    return pair.b.place(b.ball.middle) - pair.a.place(a.ball.middle);
}

VertexPair facing_vertices(const PolytopePair& pair, const Vec3& direction) {
    return {pair.a.polytope->starts.vertex(pair.a.pulled_back(direction)),
            pair.b.polytope->starts.vertex(pair.b.pulled_back(-direction))};
}

DifferenceSimplex recalled_simplex(const PolytopePair& pair, const ConvexWorkspace& workspace) {
    DifferenceSimplex simplex;
    for (const VertexPair& last : workspace.pairs)
        add_if_new(recalled(pair, last), simplex);
    return simplex;
}

void remember(const DifferenceSimplex& simplex, ConvexWorkspace& workspace) {
    workspace.kind = ConvexWorkspace::Kind::simplex;
    for (std::size_t i = 0; i < 4; ++i)
        workspace.pairs[i] = simplex.corners[i < simplex.count ? i : 0];
}

} // namespace abut
