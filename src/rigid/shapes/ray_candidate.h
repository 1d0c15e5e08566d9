#pragma once

#include <abut/shape_queries.h>

#include "geometry/ray_triangle_intersect.h"
#include "rigid/model/placed_model.h"

#include <cstdint>
#include <optional>

namespace abut {

/// A triangle that a ray meets, and where.
struct RayCandidate {
    std::uint32_t triangle = 0;
    Triangle corners{};
    RayTriangleHit hit;
};

/// The first triangle of a model that a ray meets; of several at the same t, the one of lowest
/// index.
///
/// In          a ray that `require_ray` accepts.
std::optional<RayCandidate> first_candidate(const PlacedModel& model, const Ray& ray);

RayHit describe(const Ray& ray, const RayCandidate& candidate);

} // namespace abut
