#pragma once

#include <abut/convex.h>

#include "convex/body/convex_data.h"
#include "convex/search/gjk.h"
#include "convex/search/voronoi_marching.h"
#include "math/transform.h"

#include <array>
#include <cmath>
#include <cstddef>

/// Steps that distance and penetration of convex bodies share.
namespace abut {

/// Bounds on the error of a coordinate: in the pair's frame, and compared with the positions that
/// abut/types.h computes.
struct Roundings {
    double of_pair = 0, all = 0;
};

/// Errors      Error{bad_argument} if a transform is not finite.
inline Roundings roundings_of(const ConvexData& a, const Transform& world_from_a,
                              const ConvexData& b, const Transform& world_from_b) {
    const auto &m = world_from_a.m, &n = world_from_b.m;
    // Two sums, so that two lanes may do the work.
    std::array<double, 2> sums{};
    for (std::size_t i = 0; i < 8; i += 2)
        for (std::size_t k = 0; k < 2; ++k)
            sums[k] += std::abs(m[i + k]) * a.reach + std::abs(n[i + k]) * b.reach;
    const double last = std::abs(m[8]) * a.reach + std::abs(n[8]) * b.reach;
    const double offset = sum_of_sizes(Vec3{n[9] - m[9], n[10] - m[10], n[11] - m[11]});
    const double of_pair = 0x1p-51 * (sums[0] + sums[1] + last + offset);
    // The other translation is at most this one plus the offset, which `of_pair` covers.
    const Roundings roundings{of_pair,
                              2 * of_pair + 0x1p-50 * sum_of_sizes(Vec3{m[9], m[10], m[11]})};
    if (!std::isfinite(roundings.all)) [[unlikely]] {
        require_finite(world_from_a, "transform of a");
        require_finite(world_from_b, "transform of b");
    }
    return roundings;
}

inline double rounding_of(const ConvexData& a, const Transform& world_from_a, const ConvexData& b,
                          const Transform& world_from_b) {
    return roundings_of(a, world_from_a, b, world_from_b).of_pair;
}

/// The vector from the centre of a's inner ball to that of b's, in the pair's frame.
Vec3 between_middles(const ConvexData& a, const ConvexData& b, const PolytopePair& pair);

/// The vertices that face each other along a direction, by the tables of normals.
VertexPair facing_vertices(const PolytopePair& pair, const Vec3& direction);

/// A remembered pair. Numbers that a polytope does not have are replaced by its first vertex.
inline VertexPair recalled(const PolytopePair& pair, const VertexPair& last) {
    return {last.a < pair.a.polytope->vertices.size() ? last.a : 0,
            last.b < pair.b.polytope->vertices.size() ? last.b : 0};
}

inline bool has_simplex(const ConvexWarmStart& warm_start) {
    return warm_start.kind == ConvexWarmStart::Kind::simplex;
}

/// The remembered simplex. Numbers that a polytope does not have are replaced by its first vertex.
DifferenceSimplex recalled_simplex(const PolytopePair& pair, const ConvexWarmStart& warm_start);

/// Remembers a simplex that holds the origin.
void remember(const DifferenceSimplex& simplex, ConvexWarmStart& warm_start);

/// Sets two features to the remembered ones, as far as the polytopes have them.
///
/// In          a warm start that holds features.
void recall(const PolytopePair& pair, const ConvexWarmStart& last, HullFeature& a, HullFeature& b);

/// Remembers a pair of features.
void remember(const HullFeature& a, const HullFeature& b, ConvexWarmStart& warm_start);

} // namespace abut
