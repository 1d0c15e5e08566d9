#pragma once

#include <abut/convex.h>

#include "convex/hull/placed_polytope.h"
#include "convex/hull/polytope.h"

#include <cstdint>

namespace abut {

/// A vertex of the polytope that is farthest along a direction, by going uphill from `start`.
std::uint32_t climb(const Polytope& polytope, const Vec3& direction, std::uint32_t start);

/// The same, from where the table of normals says.
inline std::uint32_t farthest(const Polytope& polytope, const Vec3& direction) {
    return climb(polytope, direction, polytope.starts.vertex(direction));
}

/// The vertices of a and b that are farthest along a direction and against it, found so.
VertexPair farthest(const PolytopePair& pair, const Vec3& direction);

} // namespace abut
