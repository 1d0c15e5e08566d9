#include "rigid/manifold/manifold_side.h"

#include "math/predicates.h"
#include "tree/traverse_one.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

bool is_mirroring(const Transform& t) {
    const auto& m = t.m;
    return dot(cross({m[0], m[1], m[2]}, {m[3], m[4], m[5]}), {m[6], m[7], m[8]}) < 0;
}

/// +1 if the line passes a triangle against its normal, -1 along it, 0 if it misses the triangle or
/// lies in its plane.
int passing_side(const Vec3& point, const Vec3& direction, const Triangle& t) {
    const int s0 = turn_around_line(point, direction, t[0], t[1]),
              s1 = turn_around_line(point, direction, t[1], t[2]);
    if (s0 * s1 < 0)
        return 0;
    const int s2 = turn_around_line(point, direction, t[2], t[0]);
    if (s0 * s2 < 0 || s1 * s2 < 0)
        return 0;
    const int sum = s0 + s1 + s2;
    return (sum < 0) - (sum > 0);
}

} // namespace

ManifoldSide::ManifoldSide(const Model& model, const Transform& world_from_model,
                           const Vec3& origin)
    : model_(model, world_from_model, origin), solid_(model.data().solid()),
      facing_(is_mirroring(world_from_model) ? -solid_.outward : solid_.outward) {}

ManifoldSide::SurfaceHit ManifoldSide::first_hit(const Vec3& point, const Vec3& direction) const {
    SurfaceHit first;
    const double far = length(model_.middle() - point) + model_.reach();
    // Bounds the rounding of the segment's end.
    const double error = 16 * 0x1p-53 * (magnitude(point) + far);
    const auto clipped = model_.tree_segment(point, point + far * direction, error);
    if (!clipped || !(far > 0))
        return first;
    float bound = 1;
    for_each_along_segment(model_.data().tree(), clipped->segment, [&](std::uint32_t slot) {
        const Triangle t = model_.world_slot(slot);
        const int side = passing_side(point, direction, t);
        if (side == 0)
            return bound;
        const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
        const double along = dot(normal, direction);
        // The height on a triangle seen on edge is not bounded by its corners' heights.
        if (std::abs(along) <= 0x1p-20 * length(normal))
            return bound;
        const double height = dot(normal, t[0] - point) / along;
        if (!(height >= 0) || (first.found && height >= first.height))
            return bound;
        first = {true, height, !is_oriented() || side * facing() < 0};
        const double s = 2 * (height / far - clipped->begin) / (clipped->end - clipped->begin) - 1;
        // The margin exceeds the rounding of s; NaN leaves the bound at 1.
        if (s < 1 - 0x1p-18)
            bound = round_up(std::max(s, -1.0) + 0x1p-18);
        return bound;
    });
    return first;
}

ManifoldSide::LineHit ManifoldSide::top_along(const Vec3& point, const Vec3& direction) const {
    const SurfaceHit ahead = first_hit(point, direction);
    if (ahead.found && ahead.leaves)
        return {true, ahead.height};
    const SurfaceHit behind = first_hit(point, -direction);
    if (behind.found && (!behind.leaves || !is_oriented()))
        return {true, -behind.height};
    return {};
}

} // namespace abut
