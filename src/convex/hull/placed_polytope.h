#pragma once

#include <abut/types.h>

#include "convex/hull/polytope.h"
#include "math/transform.h"
#include "math/vector.h"

namespace abut {

/// A polytope under a transform whose translation is replaced.
struct PlacedPolytope {
    const Polytope* polytope = nullptr;
    const Transform* linear = nullptr; ///< only its linear part is used
    Vec3 offset;

    [[nodiscard]] Vec3 place(const Vec3& v) const { return apply_linear(*linear, v) + offset; }
    [[nodiscard]] Vec3 vertex(std::uint32_t v) const { return place(polytope->vertices[v].at); }
    /// The direction d for which d . v = n . (linear part of v); n turned back, if the map is a
    /// rotation.
    [[nodiscard]] Vec3 pulled_back(const Vec3& n) const { return pull_back(*linear, n); }
};

/// Two polytopes in a common frame: the world's axes, with the origin where the first transform
/// puts that of a. So distances keep their digits however far from the world's origin both bodies
/// are.
///
/// Refers to the transforms, which must outlive it.
struct PolytopePair {
    PolytopePair(const Polytope& polytope_a, const Transform& world_from_a,
                 const Polytope& polytope_b, const Transform& world_from_b)
        : a{&polytope_a, &world_from_a, {}}, b{&polytope_b,
                                               &world_from_b,
                                               {world_from_b.m[9] - world_from_a.m[9],
                                                world_from_b.m[10] - world_from_a.m[10],
                                                world_from_b.m[11] - world_from_a.m[11]}} {}

    PlacedPolytope a, b;
};

/// A length by which rounding may move the world-frame coordinates of abut/types.h beyond those in
/// the pair's frame. It is large where bodies are far from the world's origin.
inline double world_rounding(const Transform& world_from_a, const Transform& world_from_b) {
    const auto &m = world_from_a.m, &n = world_from_b.m;
    return 0x1p-51 *
           (sum_of_sizes(Vec3{m[9], m[10], m[11]}) + sum_of_sizes(Vec3{n[9], n[10], n[11]}));
}

inline double world_rounding(const PolytopePair& pair) {
    return world_rounding(*pair.a.linear, *pair.b.linear);
}

} // namespace abut
