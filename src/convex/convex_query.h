#pragma once

#include <abut/convex.h>

#include "convex/convex_data.h"
#include "convex/simplex_search.h"

/// What queries of two convex bodies have in common.
namespace abut {

/// Lengths: no coordinate in the pair's frame is off by more, and none from where abut/types.h has it.
struct Roundings {
    double of_pair = 0, all = 0;
};

/// Errors      Error{bad_argument} if a transform is not finite.
Roundings roundings_of(const ConvexData& a, const Transform& world_from_a, const ConvexData& b,
                       const Transform& world_from_b);

inline double rounding_of(const ConvexData& a, const Transform& world_from_a, const ConvexData& b,
                          const Transform& world_from_b) {
    return roundings_of(a, world_from_a, b, world_from_b).of_pair;
}

/// From the middle of one body's inner ball to that of the other, in the pair's frame.
Vec3 between_middles(const ConvexData& a, const ConvexData& b, const PolytopePair& pair);

/// The vertices that face each other along a direction, as the tables of normals say.
VertexPair facing_vertices(const PolytopePair& pair, const Vec3& direction);

/// A remembered pair, or the first vertices if the polytopes have no such.
inline VertexPair recalled(const PolytopePair& pair, const VertexPair& last) {
    return {last.a < pair.a.polytope->vertices.size() ? last.a : 0,
            last.b < pair.b.polytope->vertices.size() ? last.b : 0};
}

inline bool has_simplex(const ConvexWorkspace& workspace) {
    return workspace.kind == ConvexWorkspace::Kind::simplex;
}

/// The simplex that is remembered, as far as the polytopes have it.
DifferenceSimplex recalled_simplex(const PolytopePair& pair, const ConvexWorkspace& workspace);

/// A simplex that holds the origin.
void remember(const DifferenceSimplex& simplex, ConvexWorkspace& workspace);

} // namespace abut
