#pragma once

#include <abut/convex.h>

#include "convex/hull/placed_polytope.h"
#include "convex/hull/polytope.h"

#include <cstdint>

namespace abut {

/// A vertex of the polytope that is farthest along a direction, by hill climbing from `start`.
std::uint32_t climb(const Polytope& polytope, const Vec3& direction, std::uint32_t start);

/// A farthest vertex, climbing from the start that the table of normals gives.
inline std::uint32_t farthest(const Polytope& polytope, const Vec3& direction) {
    return climb(polytope, direction, polytope.starts.vertex(direction));
}

/// The vertex of a that is farthest along a direction, and that of b farthest against it.
VertexPair farthest(const PolytopePair& pair, const Vec3& direction);

/// A farthest vertex of each polytope along a direction of its own.
struct FarthestPair {
    VertexPair vertices;
    /// By how much all neighbours of the vertex are lower, at least. Infinite if all vertices were
    /// compared.
    double lead_a = 0, lead_b = 0;
};
FarthestPair farthest_with_lead(const Polytope& a, const Vec3& direction_a, const Polytope& b,
                                const Vec3& direction_b);

} // namespace abut
