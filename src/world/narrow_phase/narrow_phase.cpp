#include "world/narrow_phase/narrow_phase.h"

#include <abut/shape_queries.h>

#include "convex/body/convex_data.h"
#include "convex/support/support_gap.h"
#include "math/transform.h"
#include "rigid/model/model_data.h"
#include "rigid/solid/containment.h"
#include "world/narrow_phase/contact_rounding.h"
#include "world/narrow_phase/convex_gap.h"
#include "world/narrow_phase/core_gap.h"
#include "world/narrow_phase/model_gap.h"
#include "world/narrow_phase/offset_surface.h"
#include "world/narrow_phase/solid_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>

// The table of shape pairs: an overload of `meet` and of `measure` for each pair of kinds. Surfaces
// come before convex bodies, these before rounded boxes, then curved shapes and half-spaces. For the
// opposite order, the result is swapped. A deformable counts as a model here.
namespace abut {

namespace {

template <typename Shape>
struct Placed {
    const Shape& shape;
    const Transform& world;
};
using PlacedSurface = Placed<Model>;
using PlacedConvex = Placed<ConvexShape>;
using PlacedRounded = Placed<RoundedBox>;
using PlacedCurved = Placed<CurvedShape>;
using PlacedPlane = Placed<PlaneShape>;

/// See contact_rounding.h.
template <typename ShapeA, typename ShapeB>
double rounding_of(const Placed<ShapeA>& a, const Placed<ShapeB>& b) {
    return contact_share(a.shape) + contact_share(b.shape);
}

SupportShape support_of(const PlacedConvex& convex) {
    return support_of(convex.shape, convex.world);
}
SupportShape support_of(const PlacedRounded& box) {
    return support_of(placed(box.shape, box.world));
}
SupportShape support_of(const PlacedCurved& curved) {
    return placed(curved.shape, curved.world);
}

/// A box without its radius. The axes of a body that is a plain box are those of its frame; those of a
/// compound's piece may be others.
OrientedBox oriented_box(const PlacedRounded& box) {
    const RoundedBox& shape = box.shape;
    const Vec3 half{shape.half[0], shape.half[1], shape.half[2]};
    if (shape.axis == RoundedBox().axis)
        return {Box3{shape.centre - half, shape.centre + half}, box.world};
    return {Box3{{-1, -1, -1}, {1, 1, 1}},
            compose(box.world, offset_surface_of(shape).body_from_surface)};
}

/// A rounded box without its radius. It is the image of a point, a segment or a cube whose
/// coordinates are -1 or 1, under a transform.
struct Core {
    const Convex& convex;
    Transform world;
};
Core core_of(const RoundedBox& solid) {
    static const Convex point(std::vector<Vec3>{{}}), cube(unit_cube().mesh().positions),
        segment(std::vector<Vec3>{{-1, -1, -1}, {1, 1, 1}});
    // A flat box is a cube without extent along one axis.
    return {dimension(solid) == 0   ? point
            : dimension(solid) == 1 ? segment
                                    : cube,
            offset_surface_of(solid).body_from_surface};
}

/// Subtracts a radius around b's core, which is a point, a segment or a box.
BodyGap with_radius(BodyGap core, double radius) {
    core.distance -= radius;
    core.point_b = core.point_b - radius * core.normal;
    return core;
}

bool meet(const PlacedSurface& a, const PlacedSurface& b, PairWarmStart& warm_start) {
    CollideOptions options;
    options.warm_start = &warm_start.surfaces;
    return collide(a.shape, a.world, b.shape, b.world, options).meet();
}

bool meet(const PlacedSurface& a, const PlacedConvex& b, PairWarmStart& warm_start) {
    if (meet(a, PlacedSurface{b.shape.surface, b.world}, warm_start))
        return true;
    const Model& surface = b.shape.surface;
    return any_component_inside(PlacedSolid(a.shape, a.shape.data().solid(), a.world),
                                PlacedSolid(surface, surface.data().solid(), b.world));
}

bool meet(const PlacedConvex& a, const PlacedConvex& b, PairWarmStart& warm_start) {
    ConvexDistanceOptions options;
    options.warm_start = &warm_start.solids;
    return distance(a.shape.solid, a.world, b.shape.solid, b.world, options).distance == 0;
}

/// By how much searches for the distance of two convex bodies that start elsewhere may differ, relative
/// to the distance and to the bodies' sizes: 2^-40 of the distance and some roundings (`is_tight`).
constexpr double kSearchDoubt = 0x1p-38;

/// Measures a convex body and a rounded one's core by `measure(warm_start)`, which returns the
/// distance and more. Where rounding decides whether the bodies touch, it measures from scratch, so
/// that earlier queries do not decide.
template <typename Measure>
auto measured_core(const PlacedConvex& a, const PlacedRounded& b, ConvexWarmStart& warm_start,
                   const Measure& measure) {
    auto found = measure(&warm_start);
    const double touching = rounding_of(a, b), reach = a.shape.solid.data().reach;
    const double apart = found.distance - b.shape.radius - touching;
    if (found.distance > 0 &&
        std::abs(apart) <= kSearchDoubt * (std::abs(found.distance) + reach + b.shape.radius))
        found = measure(nullptr);
    return found;
}

bool meet(const PlacedConvex& a, const PlacedRounded& b, PairWarmStart& warm_start) {
    const RoundedBox solid = placed(b.shape, b.world);
    const Core core = core_of(solid);
    const ConvexGap gap = measured_core(a, b, warm_start.solids, [&](ConvexWarmStart* warm) {
        ConvexDistanceOptions options;
        options.warm_start = warm;
        return distance(a.shape.solid, a.world, core.convex, core.world, options);
    });
    return gap.distance - solid.radius <= rounding_of(a, b);
}

bool meet(const PlacedSurface& a, const PlacedRounded& b, PairWarmStart& /*warm_start*/) {
    const RoundedBox solid = placed(b.shape, b.world);
    switch (dimension(solid)) {
    case 0:
        return overlaps(a.shape, a.world, Sphere{solid.centre, solid.radius});
    case 1: {
        const double touching = solid.radius + rounding_of(a, b);
        DistanceOptions options;
        options.upper_bound = std::nextafter(touching, HUGE_VAL);
        return distance(a.shape, a.world, axis_of(solid), options).distance <= touching;
    }
    default:
        return overlaps(a.shape, a.world, oriented_box(b));
    }
}

bool meet(const PlacedRounded& a, const PlacedRounded& b, PairWarmStart& /*warm_start*/) {
    const double touching = rounding_of(a, b);
    return rounded_box_distance(placed(a.shape, a.world), placed(b.shape, b.world), touching)
               .distance <= touching;
}

/// An order of two placed models that does not depend on which of them is a: by their sizes, then by
/// their placements.
bool is_before(const PlacedSurface& a, const PlacedSurface& b) {
    const Mesh &mesh_a = a.shape.mesh(), &mesh_b = b.shape.mesh();
    return std::tuple(mesh_a.triangles.size(), mesh_a.positions.size(), a.world.m) <
           std::tuple(mesh_b.triangles.size(), mesh_b.positions.size(), b.world.m);
}
BodyGap turned_round(const BodyGap& gap);

BodyGap measure(const PlacedSurface& a, const PlacedSurface& b, double upper_bound, Depths depths,
                PairWarmStart& warm_start) {
    // A search for a depth ends within its accuracy of it, at a number that the order decides.
    if (depths == Depths::yes && is_before(b, a))
        return turned_round(model_gap(b.shape, b.world, a.shape, a.world, upper_bound, depths,
                                      warm_start.surfaces));
    return model_gap(a.shape, a.world, b.shape, b.world, upper_bound, depths, warm_start.surfaces);
}

BodyGap measure(const PlacedSurface& a, const PlacedConvex& b, double upper_bound, Depths depths,
                PairWarmStart& warm_start) {
    BodyGap gap = model_gap(a.shape, a.world, b.shape.surface, b.world, upper_bound, depths,
                            warm_start.surfaces);
    // A surface in the solid may be far from its faces, but is in contact.
    if (gap.distance > 0 && meet(a, b, warm_start))
        set_touching(gap, kClearOfFaces * (sum_of_sizes(gap.point_b) + b.shape.solid.data().reach));
    if (is_in_open(gap, a.shape, depths))
        part_from_surface(gap, PlacedModel(a.shape, a.world), support_of(b));
    turn_to_solid(gap, apply(b.world, mean_of(b.shape.solid.vertices())),
                  b.shape.solid.data().reach);
    return gap;
}

BodyGap measure(const PlacedConvex& a, const PlacedConvex& b, double /*upper_bound*/,
                Depths /*depths*/, PairWarmStart& warm_start) {
    return convex_gap(a.shape.solid, a.world, b.shape.solid, b.world, warm_start.solids);
}

/// Returns whether a capsule's axis or a box's face is across a direction, to rounding: then there are many
/// closest points, and the start of a search decides which of them it finds.
bool lies_across(const RoundedBox& core, const Vec3& direction) {
    constexpr double kAcross = 0x1p-20; // the closest points of others are unique to 2^-20
    for (std::size_t k = 0; k < 3; ++k)
        if (core.half[k] > 0 && std::abs(dot(core.axis[k], direction)) <= kAcross)
            return true;
    return false;
}

BodyGap measure(const PlacedConvex& a, const PlacedRounded& b, double /*upper_bound*/,
                Depths /*depths*/, PairWarmStart& warm_start) {
    const RoundedBox solid = placed(b.shape, b.world);
    const Core core = core_of(solid);
    const auto gap_from = [&](ConvexWarmStart& start) {
        return convex_gap(a.shape.solid, a.world, core.convex, core.world, start);
    };
    BodyGap gap = measured_core(a, b, warm_start.solids, [&](ConvexWarmStart* warm) {
        ConvexWarmStart none;
        return gap_from(warm != nullptr ? *warm : none);
    });
    // Bodies that touch are asked for by several queries.
    if (gap.distance <= solid.radius + 2 * rounding_of(a, b) && lies_across(solid, gap.normal)) {
        ConvexWarmStart none;
        gap = gap_from(none);
    }
    return with_radius(gap, solid.radius);
}

/// Returns whether a part of a surface lies in a box, if the surface does not meet its faces.
bool any_component_inside(const PlacedSurface& a, const RoundedBox& box) {
    const ModelData& data = a.shape.data();
    const auto& components = data.solid().components;
    return std::any_of(components.begin(), components.end(), [&](std::uint32_t triangle) {
        const Vec3 from_centre = data.world_triangle(triangle, a.world)[0] - box.centre;
        for (std::size_t k = 0; k < 3; ++k)
            if (!(std::abs(dot(from_centre, box.axis[k])) <= box.half[k]))
                return false;
        return true;
    });
}

BodyGap measure(const PlacedSurface& a, const PlacedRounded& b, double upper_bound, Depths depths,
                PairWarmStart& warm_start) {
    const RoundedBox solid = placed(b.shape, b.world);
    switch (dimension(solid)) {
    case 0:
        return ball_gap(a.shape, a.world, {solid.centre, solid.radius}, upper_bound, depths);
    case 1:
        return capsule_gap(a.shape, a.world, {axis_of(solid), solid.radius}, upper_bound, depths);
    default:
        const OffsetSurface faces = offset_surface_of(b.shape);
        BodyGap gap =
            model_gap(a.shape, a.world, faces.surface, compose(b.world, faces.body_from_surface),
                      upper_bound, depths, warm_start.surfaces);
        // A surface in the box may be far from its rounded faces, but is in contact.
        const double clear = kClearOfFaces * (sum_of_sizes(solid.centre) + solid.half[0] +
                                              solid.half[1] + solid.half[2]);
        if (gap.distance > 0 &&
            (gap.distance > clear ? any_component_inside(a, solid) : meet(a, b, warm_start)))
            set_touching(gap, clear);
        if (is_in_open(gap, a.shape, depths))
            part_from_surface(gap, PlacedModel(a.shape, a.world), support_of(b));
        turn_to_solid(gap, solid.centre, solid.half[0] + solid.half[1] + solid.half[2]);
        return gap;
    }
}

BodyGap measure(const PlacedRounded& a, const PlacedRounded& b, double upper_bound,
                Depths /*depths*/, PairWarmStart& /*warm_start*/) {
    const SolidGap gap =
        rounded_box_distance(placed(a.shape, a.world), placed(b.shape, b.world), upper_bound);
    BodyGap result;
    result.distance = gap.distance, result.normal = gap.normal;
    result.point_a = gap.point_a, result.point_b = gap.point_b;
    return result;
}

/// A curved shape with a surface, and with a solid of any kind but a half-space.
bool meet(const PlacedSurface& a, const PlacedCurved& b, PairWarmStart& /*warm_start*/) {
    return surface_meets(a.shape, a.world, support_of(b), rounding_of(a, b));
}
template <typename Solid>
bool meet(const Placed<Solid>& a, const PlacedCurved& b, PairWarmStart& warm_start) {
    const SupportShape solid = support_of(a), curved = support_of(b);
    const double touching = rounding_of(a, b);
    Vec3& last = warm_start.direction;
    if (last != Vec3{} && separation_along(solid, curved, last) > 2 * touching)
        return false;
    Vec3 direction; // where rounding decides, earlier queries must not
    const SupportGap gap = support_gap(solid, curved, touching, SupportDepths::no, direction);
    if (direction != Vec3{})
        last = direction;
    return gap.distance <= touching;
}
/// The direction from which to search. A depth is searched for from scratch: where several motions
/// are equally short, the one that is found must not depend on earlier queries.
Vec3& first_direction(Depths depths, PairWarmStart& warm_start, Vec3& none) {
    return depths == Depths::yes ? none : warm_start.direction;
}
BodyGap measure(const PlacedSurface& a, const PlacedCurved& b, double upper_bound, Depths depths,
                PairWarmStart& /*warm_start*/) {
    return surface_gap(a.shape, a.world, support_of(b), upper_bound, depths);
}
template <typename Solid>
BodyGap measure(const Placed<Solid>& a, const PlacedCurved& b, double upper_bound, Depths depths,
                PairWarmStart& warm_start) {
    const SupportShape solid_a = support_of(a), solid_b = support_of(b);
    Vec3 none;
    return solid_gap(solid_a, solid_b, upper_bound, first_direction(depths, warm_start, none));
}

/// A half-space with anything.
BodyGap gap_of_plane(const PlacedSurface& a, const PlacedPlane& b) {
    return surface_gap(a.shape, a.world, placed(b.shape, b.world));
}
BodyGap gap_of_plane(const PlacedPlane& a, const PlacedPlane& b) {
    return solid_gap(placed(a.shape, a.world), placed(b.shape, b.world));
}
template <typename Solid>
BodyGap gap_of_plane(const Placed<Solid>& a, const PlacedPlane& b) {
    return solid_gap(support_of(a), placed(b.shape, b.world));
}
template <typename Shape>
bool meet(const Placed<Shape>& a, const PlacedPlane& b, PairWarmStart& /*warm_start*/) {
    return gap_of_plane(a, b).distance <= rounding_of(a, b);
}
template <typename Shape>
BodyGap measure(const Placed<Shape>& a, const PlacedPlane& b, double /*upper_bound*/,
                Depths /*depths*/, PairWarmStart& /*warm_start*/) {
    return gap_of_plane(a, b);
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
const ConvexShape& surface_of(const ConvexShape& convex) {
    return convex;
}
const RoundedBox& surface_of(const RoundedBox& box) {
    return box;
}
const CurvedShape& surface_of(const CurvedShape& curved) {
    return curved;
}
const PlaneShape& surface_of(const PlaneShape& plane) {
    return plane;
}

/// Position of a kind of shape in the table's order.
template <typename Kind>
constexpr int kRank = std::is_same_v<Kind, Model>         ? 0
                      : std::is_same_v<Kind, ConvexShape> ? 1
                      : std::is_same_v<Kind, RoundedBox>  ? 2
                      : std::is_same_v<Kind, CurvedShape> ? 3
                                                          : 4;

/// Whether two shapes of one kind are to be swapped, so that their gap does not depend on which of
/// them is a. That of surfaces and convex bodies does not anyway, but for the choice of closest
/// points.
template <typename Shape>
bool is_swapped(const Placed<Shape>& a, const Placed<Shape>& b) {
    if constexpr (std::is_same_v<Shape, RoundedBox> || std::is_same_v<Shape, CurvedShape>)
        return comes_before(b.shape, b.world, a.shape, a.world);
    else
        return false;
}

/// Calls query(a, b) with the shapes in the table's order. If that swaps them, returns
/// turn(result).
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
            // The branch that the kinds exclude is not compiled.
            if constexpr ((kRank<KindA>) > (kRank<KindB>))
                return turn(query(placed_b, placed_a));
            else if constexpr ((kRank<KindA>) < (kRank<KindB>))
                return query(placed_a, placed_b);
            else
                return is_swapped(placed_a, placed_b) ? turn(query(placed_b, placed_a))
                                                      : query(placed_a, placed_b);
        },
        a.shape, b.shape);
}

} // namespace

bool touch(const PlacedBody& a, const PlacedBody& b, PairWarmStart& warm_start) {
    return with_shapes(
        a, b, [&](const auto& x, const auto& y) { return meet(x, y, warm_start); },
        [](bool met) { return met; });
}

BodyGap gap_between(const PlacedBody& a, const PlacedBody& b, double upper_bound, Depths depths,
                    PairWarmStart& warm_start) {
    // `touch` alone decides whether bodies touch. What it decides is rounded too: a gap up to twice
    // the rounding must be known, not only that it exceeds a lower bound.
    const double rounding = contact_rounding(a, b);
    const double bound = std::max(upper_bound, 2 * rounding);
    const auto measured = [&](Depths asked) {
        return with_shapes(
            a, b,
            [&](const auto& x, const auto& y) { return measure(x, y, bound, asked, warm_start); },
            [](const BodyGap& gap_of_b) { return turned_round(gap_of_b); });
    };
    BodyGap gap = measured(depths);
    // Bodies that share a point are not apart, even if rounding says so.
    if (depths == Depths::yes && !(is_convex(a.shape) && is_convex(b.shape)))
        gap.distance = std::min(gap.distance, 0.0);
    if (rounding == 0 || !(std::abs(gap.distance) <= 2 * rounding))
        return gap;
    const bool meets = touch(a, b, warm_start);
    if (!meets && gap.normal == Vec3{}) // its rounded triangles touch
        gap.normal = measured(Depths::yes).normal;
    gap.distance = meets ? std::min(gap.distance, 0.0) : std::max(gap.distance, rounding);
    return gap;
}

BodyGap signed_gap_between(const PlacedBody& a, const PlacedBody& b, double upper_bound,
                           PairWarmStart& warm_start) {
    if (is_convex(a.shape) && is_convex(b.shape))
        return gap_between(a, b, upper_bound, Depths::yes, warm_start);
    BodyGap gap = gap_between(a, b, upper_bound, Depths::no, warm_start);
    if (gap.distance > upper_bound)
        return gap;
    // From scratch, as `collide` asks the first time.
    PairWarmStart none;
    if (touch(a, b, none))
        return gap_between(a, b, HUGE_VAL, Depths::yes, warm_start);
    // A gap that rounding hides is still a gap: the surfaces share no point, by exact arithmetic.
    gap.distance = std::max(gap.distance, std::numeric_limits<double>::min());
    return gap;
}

} // namespace abut
