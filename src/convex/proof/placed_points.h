#pragma once

#include <abut/convex.h>
#include <abut/error.h>

#include "convex/body/convex_data.h"
#include "math/transform.h"

#include <vector>

namespace abut {

/// All vertices of the hulls of two bodies, placed as abut/types.h says: the positions that "exact"
/// refers to. A body's own vertices come first, then those that its polytope leaves out.
struct PlacedPoints {
    std::vector<Vec3> a, b;
};

inline std::vector<Vec3> placed_points(const ConvexData& body, const Transform& world) {
    std::vector<Vec3> points;
    points.reserve(body.vertices.size() + body.left_out.size());
    for (const Vec3& p : body.vertices)
        points.push_back(apply(world, p));
    for (const Vec3& p : body.left_out)
        points.push_back(apply(world, p));
    return points;
}

/// Errors      Error{bad_argument} if a coordinate is not finite.
inline void require_finite(const PlacedPoints& points) {
    for (const auto* side : {&points.a, &points.b})
        for (const Vec3& p : *side)
            if (!is_finite(p))
                throw Error(ErrorCode::bad_argument,
                            "a transform places a vertex beyond the range of numbers");
}

} // namespace abut
