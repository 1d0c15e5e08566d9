#pragma once

#include <abut/types.h>

#include "convex/polytope.h"
#include "math/vector.h"

#include <array>

namespace abut {

/// The linear part of a transform.
struct LinearMap {
    Vec3 x, y, z; ///< images of the axes

    explicit LinearMap(const Transform& t)
        : x{t.m[0], t.m[1], t.m[2]}, y{t.m[3], t.m[4], t.m[5]}, z{t.m[6], t.m[7], t.m[8]} {}

    [[nodiscard]] Vec3 operator()(const Vec3& v) const {
        return {v.x * x.x + v.y * y.x + v.z * z.x, v.x * x.y + v.y * y.y + v.z * z.y,
                v.x * x.z + v.y * y.z + v.z * z.z};
    }
    /// The direction d for which d . v = n . (*this)(v): turned back, if the map is a rotation.
    [[nodiscard]] Vec3 pulled_back(const Vec3& n) const { return {dot(n, x), dot(n, y), dot(n, z)}; }
};

/// Two polytopes in a common frame: the world's axes, with the origin where the first transform puts
/// its own. So distances keep their digits however far from the world's origin both are.
struct PolytopePair {
    struct Side {
        const Polytope* polytope;
        LinearMap map;
        Vec3 offset;

        [[nodiscard]] Vec3 place(const Vec3& v) const { return map(v) + offset; }
        [[nodiscard]] Vec3 vertex(std::uint32_t v) const {
            return place(polytope->vertices[v].at);
        }
    };

    PolytopePair(const Polytope& polytope_a, const Transform& world_from_a,
                 const Polytope& polytope_b, const Transform& world_from_b)
        : a{&polytope_a, LinearMap(world_from_a), {}},
          b{&polytope_b,
            LinearMap(world_from_b),
            {world_from_b.m[9] - world_from_a.m[9], world_from_b.m[10] - world_from_a.m[10],
             world_from_b.m[11] - world_from_a.m[11]}} {}

    Side a, b;
};

} // namespace abut
