#include "world/schedule/shared_point.h"

#include "convex/support/support_gap.h"
#include "rigid/model/model_data.h"
#include "world/narrow_phase/solid_gap.h"

#include <algorithm>
#include <variant>

namespace abut {

namespace {

/// A point of two half-spaces: from the plane of a into both, as far as b needs.
Vec3 point_of_planes(const PlaneShape& a, const PlaneShape& b) {
    const Vec3 inward = normalized_or_zero(-a.normal - b.normal);
    const double speed = -dot(b.normal, inward), height = dot(b.normal, a.point - b.point);
    return speed > 0 ? a.point + (std::max(height, 0.0) / speed) * inward : a.point;
}

/// A point of a model in a solid. `nearest`: the point of its surface that is nearest to the solid's
/// surface. If that is not in the solid, a component of the model lies inside.
Vec3 point_in_solid(const Model& model, const Transform& world, const SupportShape& solid,
                    const Vec3& nearest) {
    const auto distance_of = [&](const Vec3& p) {
        SupportShape point;
        point.centre = p;
        Vec3 none;
        return support_gap(point, solid, 0, SupportDepths::no, none).distance;
    };
    if (distance_of(nearest) <= 0)
        return nearest;
    const ModelData& data = model.data();
    for (const std::uint32_t triangle : data.solid().components)
        if (const Vec3 p = data.world_triangle(triangle, world)[0]; distance_of(p) <= 0)
            return p;
    return nearest;
}

} // namespace

Vec3 shared_point(const PlacedBody& a, const PlacedBody& b, const BodyGap& gap) {
    const auto *plane_a = std::get_if<PlaneShape>(&a.shape),
               *plane_b = std::get_if<PlaneShape>(&b.shape);
    if (plane_a != nullptr && plane_b != nullptr)
        return point_of_planes(placed(*plane_a, a.world_from_body),
                               placed(*plane_b, b.world_from_body));
    if (plane_a != nullptr || plane_b != nullptr) // the lowest point of the other body
        return plane_a != nullptr ? gap.point_b : gap.point_a;
    const auto solid_a = support_of(a), solid_b = support_of(b);
    if (solid_a && solid_b)
        return common_point(*solid_a, *solid_b);
    if (solid_b)
        return point_in_solid(std::get<Model>(a.shape), a.world_from_body, *solid_b, gap.point_a);
    if (solid_a)
        return point_in_solid(std::get<Model>(b.shape), b.world_from_body, *solid_a, gap.point_b);
    return gap.point_a;
}

} // namespace abut
