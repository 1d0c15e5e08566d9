#pragma once

#include <abut/model.h>
#include <abut/rigid.h>

#include "math/transform.h"
#include "rigid/model/solid.h"

#include <algorithm>
#include <cmath>

namespace abut::test {

/// Two solids and their places.
struct TwoSolids {
    Model a, b;
    Transform world_a, world_b;
};

inline bool share_a_point(const TwoSolids& s) {
    if (collide(s.a, s.world_a, s.b, s.world_b).meet())
        return true;
    // Where a surface intersects itself, it may wind around a point twice, so parity is not
    // sufficient.
    const auto contains_any = [](const Model& outer, const Transform& world_outer,
                                 const Model& inner, const Transform& world_inner) {
        const Transform outer_from_inner = compose(inverse(world_outer), world_inner);
        const auto& triangles = inner.mesh().triangles;
        return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
            const Vec3 p = apply(outer_from_inner, inner.mesh().positions[t[0]]);
            return std::abs(winding_number(outer.mesh(), p)) > 0.5;
        });
    };
    return contains_any(s.a, s.world_a, s.b, s.world_b) ||
           contains_any(s.b, s.world_b, s.a, s.world_a);
}

} // namespace abut::test
