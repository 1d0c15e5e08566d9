#include "world/narrow_phase.h"

#include <abut/shape_queries.h>

#include "math/transform.h"
#include "rigid/model_data.h"

#include <algorithm>
#include <cmath>

// The table of pairs: one overload of `meet` and of `measure` for each pair of kinds of shape, in one
// order; the other order is turned round. A deformable is a model here.
namespace abut {

namespace {

template <typename Shape>
struct Placed {
    const Shape& shape;
    const Transform& world;
};
using PlacedSurface = Placed<Model>;
using PlacedRounded = Placed<RoundedBox>;

int dimension(const RoundedBox& box) {
    return static_cast<int>(3 - std::count(box.half.begin(), box.half.end(), 0.0));
}

Segment axis_of(const RoundedBox& capsule) {
    const auto longest = static_cast<std::size_t>(
        std::max_element(capsule.half.begin(), capsule.half.end()) - capsule.half.begin());
    const Vec3 along = capsule.half[longest] * capsule.axis[longest];
    return {capsule.centre - along, capsule.centre + along};
}

/// The box of a body that is one, in the body's frame, where its axes are the frame's.
Box3 own_box(const RoundedBox& box) {
    const Vec3 half{box.half[0], box.half[1], box.half[2]};
    return {box.centre - half, box.centre + half};
}

/// From -1 to 1 on all axes.
const Model& cube() {
    static const Model model(Mesh{{{-1, -1, -1},
                                   {1, -1, -1},
                                   {-1, 1, -1},
                                   {1, 1, -1},
                                   {-1, -1, 1},
                                   {1, -1, 1},
                                   {-1, 1, 1},
                                   {1, 1, 1}},
                                  {{0, 2, 1},
                                   {1, 2, 3},
                                   {4, 5, 6},
                                   {5, 7, 6},
                                   {0, 1, 4},
                                   {1, 5, 4},
                                   {2, 6, 3},
                                   {3, 6, 7},
                                   {0, 4, 2},
                                   {2, 4, 6},
                                   {1, 3, 5},
                                   {3, 7, 5}}});
    return model;
}
Transform world_from_cube(const PlacedRounded& box) {
    const Vec3& c = box.shape.centre;
    const auto& h = box.shape.half;
    return compose(box.world, Transform({h[0], 0, 0, 0, h[1], 0, 0, 0, h[2], c.x, c.y, c.z}));
}

bool has_inside(const Model& model) {
    return model.data().solid().closed;
}

BodyGap from_rigid(const Gap& gap) {
    BodyGap result{{},          {}, gap.distance,   gap.point_a,
                   gap.point_b, {}, gap.triangle_a, gap.triangle_b,
                   gap.status};
    // Of bodies that meet, moving b brings its point to a's.
    const Vec3 way = gap.point_b - gap.point_a;
    result.normal = normalized_or_zero(gap.distance < 0 ? -way : way);
    return result;
}

BodyGap measure_models(const Model& a, const Transform& world_from_a, const Model& b,
                       const Transform& world_from_b, double upper_bound, Depths depths,
                       Workspace& workspace) {
    DistanceOptions options;
    options.upper_bound = std::max(upper_bound, 0.0);
    options.signed_distance = depths == Depths::yes;
    options.workspace = &workspace;
    return from_rigid(distance(a, world_from_a, b, world_from_b, options));
}

/// Of a point or a segment with a distance from a surface, and a radius around it.
BodyGap with_radius(BodyGap core, double radius) {
    core.distance -= radius;
    core.point_b = core.point_b - radius * core.normal;
    return core;
}

bool meet(const PlacedSurface& a, const PlacedSurface& b, Workspace& workspace) {
    CollideOptions options;
    options.workspace = &workspace;
    return collide(a.shape, a.world, b.shape, b.world, options).any();
}

bool meet(const PlacedSurface& a, const PlacedRounded& b, Workspace& /*workspace*/) {
    const RoundedBox solid = placed(b.shape, b.world);
    switch (dimension(solid)) {
    case 0:
        return overlaps(a.shape, a.world, Sphere{solid.centre, solid.radius});
    case 1: {
        DistanceOptions options;
        options.upper_bound = std::nextafter(solid.radius, HUGE_VAL);
        return distance(a.shape, a.world, axis_of(solid), options).distance <= solid.radius;
    }
    default:
        return overlaps(a.shape, a.world, OrientedBox{own_box(b.shape), b.world});
    }
}

bool meet(const PlacedRounded& a, const PlacedRounded& b, Workspace& /*workspace*/) {
    return rounded_box_distance(placed(a.shape, a.world), placed(b.shape, b.world), 0).distance <=
           0;
}

BodyGap measure(const PlacedSurface& a, const PlacedSurface& b, double upper_bound, Depths depths,
                Workspace& workspace) {
    return measure_models(a.shape, a.world, b.shape, b.world, upper_bound, depths, workspace);
}

BodyGap measure_point(const PlacedSurface& a, const Vec3& centre, double upper_bound,
                      Depths depths) {
    NearestOptions options;
    options.upper_bound = upper_bound;
    options.signed_distance = depths == Depths::yes && has_inside(a.shape);
    const Nearest found = nearest(a.shape, a.world, centre, options);
    BodyGap gap;
    gap.distance = found.distance, gap.status = found.status;
    gap.point_a = found.point, gap.point_b = centre, gap.triangle_a = found.triangle;
    const Vec3 way = centre - found.point;
    gap.normal = normalized_or_zero(found.distance < 0 ? -way : way);
    return gap;
}

BodyGap measure(const PlacedSurface& a, const PlacedRounded& b, double upper_bound, Depths depths,
                Workspace& workspace) {
    const RoundedBox solid = placed(b.shape, b.world);
    // More by what rounding takes when the radius is subtracted again.
    const double bound = (std::max(upper_bound, 0.0) + solid.radius) * (1 + 0x1p-50);
    switch (dimension(solid)) {
    case 0:
        return with_radius(measure_point(a, solid.centre, bound, depths), solid.radius);
    case 1: {
        DistanceOptions options;
        options.upper_bound = bound;
        BodyGap core = from_rigid(distance(a.shape, a.world, axis_of(solid), options));
        // Where the axis crosses the surface, the radius is part of the depth.
        if (core.distance == 0)
            core.status = Status::bound_only;
        return with_radius(core, solid.radius);
    }
    default:
        BodyGap gap = measure_models(a.shape, a.world, cube(), world_from_cube(b), upper_bound,
                                     depths, workspace);
        // A surface inside the box is none that its faces are near to.
        if (gap.distance > 0 && meet(a, b, workspace))
            gap.distance = 0, gap.normal = {};
        return gap;
    }
}

BodyGap measure(const PlacedRounded& a, const PlacedRounded& b, double upper_bound,
                Depths /*depths*/, Workspace& /*workspace*/) {
    const SolidGap gap =
        rounded_box_distance(placed(a.shape, a.world), placed(b.shape, b.world), upper_bound);
    BodyGap result;
    result.distance = gap.distance, result.normal = gap.normal;
    result.point_a = gap.point_a, result.point_b = gap.point_b;
    return result;
}

BodyGap turned_round(const BodyGap& gap) {
    return {gap.b,       gap.a,          gap.distance,   gap.point_b, gap.point_a,
            -gap.normal, gap.triangle_b, gap.triangle_a, gap.status};
}

const Model& surface_of(const Model& model) {
    return model;
}
const Model& surface_of(const DeformableShape& deformable) {
    return deformable.snapshot->model();
}
const RoundedBox& surface_of(const RoundedBox& box) {
    return box;
}

/// Calls query(a, b) with the shapes, surfaces first; turn(result) where that has changed the order.
template <typename Query, typename Turn>
auto with_shapes(const PlacedBody& a, const PlacedBody& b, const Query& query, const Turn& turn) {
    return std::visit(
        [&](const auto& shape_a, const auto& shape_b) {
            const auto& kind_a = surface_of(shape_a);
            const auto& kind_b = surface_of(shape_b);
            using KindA = std::decay_t<decltype(kind_a)>;
            using KindB = std::decay_t<decltype(kind_b)>;
            const Placed<KindA> placed_a{kind_a, a.world_from_body};
            const Placed<KindB> placed_b{kind_b, b.world_from_body};
            if constexpr (std::is_same_v<KindA, RoundedBox> && std::is_same_v<KindB, Model>)
                return turn(query(placed_b, placed_a));
            else
                return query(placed_a, placed_b);
        },
        a.shape, b.shape);
}

} // namespace

bool touch(const PlacedBody& a, const PlacedBody& b, Workspace& workspace) {
    return with_shapes(
        a, b, [&](const auto& x, const auto& y) { return meet(x, y, workspace); },
        [](bool met) { return met; });
}

BodyGap gap_between(const PlacedBody& a, const PlacedBody& b, double upper_bound, Depths depths,
                    Workspace& workspace) {
    return with_shapes(
        a, b,
        [&](const auto& x, const auto& y) { return measure(x, y, upper_bound, depths, workspace); },
        [](const BodyGap& gap) { return turned_round(gap); });
}

} // namespace abut
