#include "world/queries/ray_body.h"

#include <abut/shape_queries.h>

#include "convex/body/convex_data.h"
#include "math/transform.h"
#include "math/vector.h"
#include "rigid/model/model_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

namespace abut {

namespace {

/// The part of a line inside a convex set, and the set's outward normal where the line enters.
struct LinePart {
    double from = -HUGE_VAL, to = HUGE_VAL;
    Vec3 normal;

    [[nodiscard]] bool is_empty() const { return !(from <= to); }
    /// Keeps the part in another set.
    void keep(const LinePart& other) {
        if (other.from > from)
            from = other.from, normal = other.normal;
        to = std::min(to, other.to);
    }
};
constexpr LinePart kNoPart{1, 0, {}};

/// A line in the frame of a solid.
struct Line {
    Vec3 origin, way;
    [[nodiscard]] Vec3 at(double t) const { return origin + t * way; }
};

/// Behind a plane: dot(normal, x) <= offset.
LinePart behind(const Line& line, const Vec3& normal, double offset) {
    const double over = dot(normal, line.origin) - offset, rise = dot(normal, line.way);
    if (rise == 0)
        return over <= 0 ? LinePart{} : kNoPart;
    const double t = -over / rise;
    return rise < 0 ? LinePart{t, HUGE_VAL, normal} : LinePart{-HUGE_VAL, t, {}};
}

/// Where a t^2 + 2 b t + c <= 0, for a >= 0. The roots keep their digits: none is a difference of two
/// numbers that are nearly equal.
LinePart where_negative(double a, double b, double c) {
    if (a == 0)
        return c <= 0 ? LinePart{} : kNoPart;
    const double root_sq = b * b - a * c;
    if (!(root_sq >= 0))
        return kNoPart;
    const double q = -(b + std::copysign(std::sqrt(root_sq), b));
    const double s = q / a, t = q != 0 ? c / q : s;
    return {std::min(s, t), std::max(s, t), {}};
}

LinePart inside_ball(const Line& line, const Vec3& centre, double radius) {
    // From the point of the line that is nearest to the centre: far origins lose nothing.
    const double aa = length_sq(line.way), nearest = dot(centre - line.origin, line.way) / aa;
    const Vec3 from = line.at(nearest) - centre;
    LinePart inside = where_negative(aa, dot(line.way, from), length_sq(from) - radius * radius);
    if (inside.is_empty())
        return inside;
    inside.normal = normalized_or_zero(from + inside.from * line.way);
    inside.from += nearest, inside.to += nearest;
    return inside;
}

/// LinePart a cylinder without ends, or without end: around a line through `on` along a unit vector.
LinePart inside_tube(const Line& line, const Vec3& on, const Vec3& along, double radius) {
    const auto across = [&](const Vec3& v) { return v - dot(v, along) * along; };
    const Vec3 way = across(line.way);
    const double aa = length_sq(way);
    if (!(aa > 0x1p-100 * length_sq(line.way)))
        return length(across(line.origin - on)) <= radius ? LinePart{} : kNoPart;
    const double nearest = dot(across(on - line.origin), way) / aa;
    const Vec3 from = across(line.at(nearest) - on);
    LinePart inside = where_negative(aa, dot(way, from), length_sq(from) - radius * radius);
    if (inside.is_empty())
        return inside;
    inside.normal = normalized_or_zero(from + inside.from * way);
    inside.from += nearest, inside.to += nearest;
    return inside;
}

/// Returns the part of a line in the union of two convex sets that share a point. It begins where the line
/// enters the first of them.
LinePart first_of(const LinePart& s, const LinePart& t) {
    if (s.is_empty() || t.is_empty())
        return s.is_empty() ? t : s;
    LinePart first = t.from < s.from ? t : s;
    first.to = std::max(s.to, t.to);
    return first;
}

LinePart inside_box(const Line& line, const RoundedBox& box) {
    LinePart inside;
    for (std::size_t k = 0; k < 3; ++k) {
        const double middle = dot(box.axis[k], box.centre);
        inside.keep(behind(line, box.axis[k], middle + box.half[k]));
        inside.keep(behind(line, -box.axis[k], box.half[k] - middle));
    }
    return inside;
}

LinePart inside_rounded(const Line& line, const RoundedBox& solid) {
    if (dimension(solid) > 1)
        return inside_box(line, solid);
    if (dimension(solid) == 0)
        return inside_ball(line, solid.centre, solid.radius);
    const Segment axis = axis_of(solid);
    const Vec3 along = normalized_or_zero(axis.b - axis.a);
    LinePart side = inside_tube(line, axis.a, along, solid.radius);
    side.keep(behind(line, along, dot(along, axis.b)));
    side.keep(behind(line, -along, -dot(along, axis.a)));
    return first_of(side, first_of(inside_ball(line, axis.a, solid.radius),
                                   inside_ball(line, axis.b, solid.radius)));
}

/// LinePart a cone: its base at -half[2] along axis[2], its apex at half[2].
LinePart inside_cone(const Line& line, const SupportShape& cone) {
    const Vec3 up = cone.axis[2], apex = cone.centre + cone.half[2] * up;
    const double slope = cone.half[0] / (2 * cone.half[2]);
    LinePart slab = behind(line, -up, -(dot(up, cone.centre) - cone.half[2]));
    slab.keep(behind(line, up, dot(up, apex)));
    // Across the axis, a point is at most slope times as far from it as it lies below the apex.
    const Vec3 from = line.origin - apex;
    const double below = -dot(from, up), falls = -dot(line.way, up), k = slope * slope;
    const Vec3 across = from + below * up, way = line.way + falls * up;
    const double a = length_sq(way) - k * falls * falls, b = dot(across, way) - k * below * falls,
                 c = length_sq(across) - k * below * below;
    LinePart inside = slab;
    if (a >= 0) {
        inside.keep(where_negative(a, b, c));
    } else {
        // Outside of both roots, each on one of the two halves of the double cone.
        const LinePart between = where_negative(-a, -b, -c);
        if (!between.is_empty()) {
            LinePart upper = slab;
            upper.keep({between.to, HUGE_VAL, {}});
            inside.keep({-HUGE_VAL, between.from, {}});
            if (inside.is_empty())
                inside = upper;
        }
    }
    if (!inside.is_empty() && inside.normal == Vec3{}) {
        const Vec3 p = line.at(inside.from) - apex, out = p - dot(p, up) * up;
        inside.normal = normalized_or_zero(normalized_or_zero(out) + slope * up);
    }
    return inside;
}

LinePart inside_ellipsoid(const Line& line, const SupportShape& solid) {
    LinePart inside;
    double a = 0, b = 0, c = -1;
    const Vec3 from = line.origin - solid.centre;
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = dot(solid.axis[k], from), way = dot(solid.axis[k], line.way),
                     half = solid.half[k];
        if (half == 0) { // flat
            const double middle = dot(solid.axis[k], solid.centre);
            inside.keep(behind(line, solid.axis[k], middle));
            inside.keep(behind(line, -solid.axis[k], -middle));
            continue;
        }
        a += (way / half) * (way / half), b += (at / half) * (way / half);
        c += (at / half) * (at / half);
    }
    inside.keep(where_negative(a, b, c));
    if (!inside.is_empty() && inside.normal == Vec3{}) {
        const Vec3 p = line.at(inside.from) - solid.centre;
        for (std::size_t k = 0; k < 3; ++k)
            if (solid.half[k] > 0)
                inside.normal =
                    inside.normal +
                    (dot(solid.axis[k], p) / (solid.half[k] * solid.half[k])) * solid.axis[k];
        inside.normal = normalized_or_zero(inside.normal);
    }
    return inside;
}

LinePart inside_curved(const Line& line, const SupportShape& solid) {
    if (solid.kind == CoreKind::ellipsoid)
        return inside_ellipsoid(line, solid);
    if (solid.kind == CoreKind::cone && solid.half[2] > 0)
        return inside_cone(line, solid);
    const Vec3& along = solid.axis[2];
    const double middle = dot(along, solid.centre);
    LinePart inside = inside_tube(line, solid.centre, along, solid.half[0]);
    inside.keep(behind(line, along, middle + solid.half[2]));
    inside.keep(behind(line, -along, solid.half[2] - middle));
    return inside;
}

LinePart inside_convex(const Line& line, const ConvexShape& convex) {
    LinePart inside;
    const FaceTable& faces = *convex.faces;
    for (std::uint32_t f = 0; f < faces.size() && !inside.is_empty(); ++f)
        inside.keep(behind(line, faces.normal(f), faces.offset(f)));
    return inside;
}

BodyRayHit surface_hit(const Model& model, const Transform& world, const Ray& ray,
                       const Progress& progress) {
    const RayHit found = first_hit(model, world, ray, progress);
    BodyRayHit hit;
    if (!found.meet)
        return hit;
    hit.meet = true, hit.t = found.t, hit.point = found.point, hit.triangle = found.triangle;
    if (found.side == HitSide::along)
        return hit;
    const Triangle t = model.data().world_triangle(found.triangle, world);
    hit.normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
    if (dot(hit.normal, ray.direction) > 0)
        hit.normal = -hit.normal;
    return hit;
}

} // namespace

BodyRayHit ray_body_hit(const PlacedBody& body, const Ray& ray, const Progress& progress) {
    const Transform& world = body.world_from_body;
    if (const auto* model = std::get_if<Model>(&body.shape))
        return surface_hit(*model, world, ray, progress);
    if (const auto* deformable = std::get_if<DeformableShape>(&body.shape))
        return surface_hit(deformable->snapshot->model(), world, ray, progress);
    const auto* convex = std::get_if<ConvexShape>(&body.shape);
    if (convex != nullptr && convex->solid.dimension() < 3)
        return surface_hit(convex->surface, world, ray, progress);
    // In the body's frame, where its place is taken off first: bodies far from the origin lose nothing.
    const auto& m = world.m;
    const Line line{pull_back(world, ray.origin - Vec3{m[9], m[10], m[11]}),
                    pull_back(world, ray.direction)};
    LinePart inside;
    if (convex != nullptr)
        inside = inside_convex(line, *convex);
    else if (const auto* rounded = std::get_if<RoundedBox>(&body.shape))
        inside = inside_rounded(line, *rounded);
    else if (const auto* curved = std::get_if<CurvedShape>(&body.shape))
        inside = inside_curved(line, curved->solid);
    else if (const auto* plane = std::get_if<PlaneShape>(&body.shape))
        inside = behind(line, plane->normal, dot(plane->normal, plane->point));
    BodyRayHit hit;
    if (inside.is_empty() || inside.to < ray.t_min || inside.from > ray.t_max ||
        !(ray.t_min <= ray.t_max))
        return hit;
    hit.meet = true;
    const bool begins_inside = inside.from < ray.t_min;
    hit.t = begins_inside ? ray.t_min : inside.from;
    hit.point = ray.origin + hit.t * ray.direction;
    if (!begins_inside)
        hit.normal = apply_linear(world, inside.normal);
    return hit;
}

} // namespace abut
