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

} // namespace abut
