#include "world/narrow_phase/body.h"

#include "convex/body/convex_data.h"
#include "convex/hull/climb.h"
#include "deform/deformable_data.h"
#include "math/transform.h"
#include "rigid/shapes/shape_arguments.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Relative error of a computed coordinate.
constexpr double kBoxRounding = 0x1p-48;

Box3 grown(const Vec3& centre, const Vec3& half) {
    const auto outward = [](double c, double h) { return h + kBoxRounding * (std::abs(c) + h); };
    const Vec3 by{outward(centre.x, half.x), outward(centre.y, half.y), outward(centre.z, half.z)};
    return {centre - by, centre + by};
}

Vec3 absolute(const Vec3& v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// The box of the vertices that are extreme along the axes. It is tight.
Box3 bounds_of_convex(const ConvexData& convex, const Transform& world_from_body) {
    const Polytope& polytope = convex.levels.front().polytope;
    const auto& m = world_from_body.m;
    Box3 box;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            const Vec3 along{sign * m[axis], sign * m[axis + 3], sign * m[axis + 6]};
            extend(box, apply(world_from_body, polytope.vertices[farthest(polytope, along)].at));
        }
    // The extreme vertex is found up to the rounding of sums, whose terms may be larger than the
    // sum.
    double size = max_abs({m[9], m[10], m[11]});
    for (std::size_t i = 0; i < 9; ++i)
        size = std::max(size, std::abs(m[i]) * convex.reach);
    const Vec3 error = 8 * kBoxRounding * Vec3{size, size, size};
    return {box.lower - error, box.upper + error};
}

/// The points that are farthest along the axes. The box is tight.
Box3 bounds_of_support(const SupportShape& shape) {
    Box3 box;
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
        for (const Vec3& direction : {axis, -axis})
            extend(box, shape.centre + farthest(shape, direction));
    return grown(box, 8 * kBoxRounding * (max_abs(shape.centre) + shape.reach));
}

/// Everything, but for the far side of a plane that is exactly across an axis.
Box3 bounds_of_plane(const PlaneShape& plane) {
    constexpr double kAll = std::numeric_limits<double>::infinity();
    const double margin = 8 * kBoxRounding * max_abs(plane.point);
    Box3 box{{-kAll, -kAll, -kAll}, {kAll, kAll, kAll}};
    const auto cut = [&](double n, double other, double another, double at, double& lower,
                         double& upper) {
        if (n == 0 || other != 0 || another != 0)
            return;
        if (n > 0)
            upper = at + margin;
        else
            lower = at - margin;
    };
    const auto& [x, y, z] = plane.normal;
    cut(x, y, z, plane.point.x, box.lower.x, box.upper.x);
    cut(y, z, x, plane.point.y, box.lower.y, box.upper.y);
    cut(z, x, y, plane.point.z, box.lower.z, box.upper.z);
    return box;
}

/// The axes of a frame whose third axis is along a segment.
std::array<Vec3, 3> axes_along(const Vec3& way, double length_of_way) {
    const Vec3 z = (1 / length_of_way) * way, x = perpendicular(z);
    return {x, cross(z, x), z};
}

/// A cylinder or cone from its base to its top.
CurvedShape round_shape(CoreKind kind, const Segment& axis, double radius) {
    require_point(axis.a, "an end of the axis");
    require_point(axis.b, "an end of the axis");
    require(!std::isnan(radius), "radius is not a number");
    require(radius >= 0 && radius <= kLargestCoordinate,
            "radius must not be negative, nor beyond 1e18");
    CurvedShape shape;
    SupportShape& solid = shape.solid;
    solid.kind = kind;
    solid.centre = 0.5 * axis.a + 0.5 * axis.b;
    const Vec3 half = 0.5 * axis.b - 0.5 * axis.a;
    solid.half = {radius, radius, length(half)};
    require(solid.half[2] > 0 || radius == 0, "its ends are equal, so its axis has no direction");
    if (solid.half[2] > 0)
        solid.axis = axes_along(half, solid.half[2]);
    solid.reach = std::sqrt(radius * radius + length_sq(half)) * (1 + kBoxRounding);
    return shape;
}

Box3 bounds_of_deformable(const Deformable& surface) {
    Box3 box;
    for (const MovingVertex& vertex : surface.data().vertices)
        extend(box, vertex.start), extend(box, vertex.end);
    return box;
}

} // namespace

const Model& Snapshot::model() const {
    std::call_once(once_, [&] { model_.emplace(surface_->model()); });
    return *model_;
}

BodyShape shape_of(const Convex& convex) {
    return ConvexShape{convex, Model(convex.mesh()), std::make_shared<const FaceTable>(convex)};
}

BodyShape shape_of(const Sphere& sphere) {
    require(!std::isnan(sphere.radius), "radius of the sphere is not a number");
    require_sphere(sphere);
    RoundedBox box;
    box.centre = sphere.centre, box.radius = sphere.radius;
    return box;
}

BodyShape shape_of(const Capsule& capsule) {
    require_segment(capsule.axis);
    require(!std::isnan(capsule.radius), "radius of the capsule is not a number");
    require_sphere({capsule.axis.a, capsule.radius});
    RoundedBox box;
    box.centre = 0.5 * capsule.axis.a + 0.5 * capsule.axis.b, box.radius = capsule.radius;
    const Vec3 half = 0.5 * capsule.axis.b - 0.5 * capsule.axis.a;
    box.half[2] = length(half);
    if (box.half[2] > 0) {
        const Vec3 z = (1 / box.half[2]) * half;
        // Any vector that is not parallel to z determines the other two axes.
        const Vec3 other = std::abs(z.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 x = normalized_or_zero(cross(other, z));
        box.axis = {x, cross(z, x), z};
    }
    return box;
}

BodyShape shape_of(const Box3& box) {
    require(require_box(box), "box is empty");
    const Vec3 half = 0.5 * box.upper - 0.5 * box.lower;
    RoundedBox rounded;
    rounded.centre = 0.5 * box.lower + 0.5 * box.upper;
    rounded.half = {half.x, half.y, half.z};
    return rounded;
}

BodyShape shape_of(const Cylinder& cylinder) {
    return round_shape(CoreKind::cylinder, cylinder.axis, cylinder.radius);
}

BodyShape shape_of(const Cone& cone) {
    return round_shape(CoreKind::cone, {cone.base, cone.apex}, cone.radius);
}

BodyShape shape_of(const Ellipsoid& ellipsoid) {
    require_point(ellipsoid.centre, "centre of the ellipsoid");
    const auto& [a, b, c] = ellipsoid.semi_axes;
    for (const double semi_axis : {a, b, c}) {
        require(!std::isnan(semi_axis), "a semi-axis of the ellipsoid is not a number");
        require(semi_axis >= 0 && semi_axis <= kLargestCoordinate,
                "a semi-axis of the ellipsoid must not be negative, nor beyond 1e18");
    }
    CurvedShape shape;
    shape.solid.kind = CoreKind::ellipsoid;
    shape.solid.centre = ellipsoid.centre;
    shape.solid.half = {a, b, c};
    shape.solid.reach = max_abs(ellipsoid.semi_axes);
    return shape;
}

BodyShape shape_of(const HalfSpace& half_space) {
    require(is_finite(half_space.normal), "normal of the half-space is not finite");
    const double size = max_abs(half_space.normal);
    require(size > 0, "normal of the half-space is zero");
    const Vec3 scaled_normal = (1 / size) * half_space.normal;
    require(is_finite(scaled_normal), "normal of the half-space is too short");
    const double stretch = length(scaled_normal), offset = half_space.offset / size / stretch;
    require(std::abs(offset) <= kLargestCoordinate, "plane of the half-space is beyond 1e18");
    const Vec3 normal = (1 / stretch) * scaled_normal;
    return PlaneShape{offset * normal, normal};
}

BodyShape shape_of(std::shared_ptr<const Deformable> surface) {
    auto snapshot = std::make_shared<const Snapshot>(surface);
    return DeformableShape{std::move(surface), std::move(snapshot)};
}

RoundedBox placed(const RoundedBox& box, const Transform& world_from_body) {
    RoundedBox result = box;
    place(result, box, world_from_body);
    return result;
}

void place(RoundedBox& in_world, const RoundedBox& box, const Transform& world_from_body) {
    in_world.centre = apply(world_from_body, box.centre);
    for (std::size_t k = 0; k < 3; ++k)
        in_world.axis[k] = apply_linear(world_from_body, box.axis[k]);
}

SupportShape placed(const CurvedShape& curved, const Transform& world_from_body) {
    SupportShape result = curved.solid;
    result.centre = apply(world_from_body, result.centre);
    for (Vec3& axis : result.axis)
        axis = apply_linear(world_from_body, axis);
    return result;
}

PlaneShape placed(const PlaneShape& plane, const Transform& world_from_body) {
    return {apply(world_from_body, plane.point), apply_linear(world_from_body, plane.normal)};
}

int dimension(const RoundedBox& box) {
    return static_cast<int>(3 - std::count(box.half.begin(), box.half.end(), 0.0));
}

Segment axis_of(const RoundedBox& capsule) {
    const auto longest = static_cast<std::size_t>(
        std::max_element(capsule.half.begin(), capsule.half.end()) - capsule.half.begin());
    const Vec3 along = capsule.half[longest] * capsule.axis[longest];
    return {capsule.centre - along, capsule.centre + along};
}

Box3 bounds_of(const RoundedBox& box) {
    Vec3 half{box.radius, box.radius, box.radius};
    for (std::size_t k = 0; k < 3; ++k)
        half = half + box.half[k] * absolute(box.axis[k]);
    return grown(box.centre, half);
}

Box3 bounds_of(const BodyShape& shape) {
    if (const auto* curved = std::get_if<CurvedShape>(&shape))
        return bounds_of_support(curved->solid);
    if (const auto* plane = std::get_if<PlaneShape>(&shape))
        return bounds_of_plane(*plane);
    if (const auto* box = std::get_if<RoundedBox>(&shape))
        return bounds_of(*box);
    if (const auto* deformable = std::get_if<DeformableShape>(&shape))
        return bounds_of_deformable(*deformable->surface);
    Box3 box;
    if (const auto* convex = std::get_if<ConvexShape>(&shape)) {
        for (const Vec3& vertex : convex->solid.vertices())
            extend(box, vertex);
        return box;
    }
    const Mesh& mesh = std::get<Model>(shape).mesh();
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle)
            extend(box, mesh.positions[vertex]);
    return box;
}

Box3 bounds_of(const BodyShape& shape, const Box3& own_bounds, const Transform& world_from_body) {
    if (const auto* box = std::get_if<RoundedBox>(&shape))
        return bounds_of(placed(*box, world_from_body));
    if (const auto* convex = std::get_if<ConvexShape>(&shape))
        return bounds_of_convex(convex->solid.data(), world_from_body);
    if (const auto* curved = std::get_if<CurvedShape>(&shape))
        return bounds_of_support(placed(*curved, world_from_body));
    if (const auto* plane = std::get_if<PlaneShape>(&shape))
        return bounds_of_plane(placed(*plane, world_from_body));
    if (is_empty(own_bounds) || is_deformable(shape))
        return own_bounds;
    return placed_bounds(own_bounds, world_from_body);
}

Box3 placed_bounds(const Box3& own_bounds, const Transform& world_from_body) {
    const auto& m = world_from_body.m;
    const Vec3 centre = 0.5 * own_bounds.lower + 0.5 * own_bounds.upper,
               half = 0.5 * own_bounds.upper - 0.5 * own_bounds.lower;
    const Vec3 turned = half.x * absolute({m[0], m[1], m[2]}) +
                        half.y * absolute({m[3], m[4], m[5]}) +
                        half.z * absolute({m[6], m[7], m[8]});
    // The rounding of a position is relative to its terms, which may be larger than their sum.
    const double stretch = *std::max_element(
        m.begin(), m.begin() + 9, [](double a, double b) { return std::abs(a) < std::abs(b); });
    const double size = std::max(1.0, std::abs(stretch)) * (max_abs(centre) + max_abs(half)) +
                        max_abs({m[9], m[10], m[11]});
    const double error = 8 * kBoxRounding * size;
    return grown(apply(world_from_body, centre), turned + Vec3{error, error, error});
}

double reach_from(const BodyShape& shape, const Box3& own_bounds, const Vec3& point) {
    if (const auto* box = std::get_if<RoundedBox>(&shape))
        return (length(box->centre - point) + length({box->half[0], box->half[1], box->half[2]}) +
                box->radius) *
               (1 + kBoxRounding);
    if (const auto* curved = std::get_if<CurvedShape>(&shape))
        return (length(curved->solid.centre - point) + curved->solid.reach) * (1 + kBoxRounding);
    if (is_half_space(shape))
        return std::numeric_limits<double>::infinity();
    if (is_empty(own_bounds))
        return 0;
    return length(max(absolute(own_bounds.lower - point), absolute(own_bounds.upper - point))) *
           (1 + kBoxRounding);
}

} // namespace abut
