#include "world/narrow_phase/core_gap.h"

#include <abut/shape_queries.h>

#include "geometry/supporting_normal.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_penetration.h"
#include "math/transform.h"
#include "rigid/model/model_data.h"
#include "rigid/penetration/deepest_point.h"
#include "rigid/solid/placed_solid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace abut {

namespace {

/// The vector between two points tells the direction from a face if it is longer than this share of
/// the coordinates: it is rounded by 2^-28 of its length then. The normal of the face always does.
constexpr double kClearOfFace = 0x1p-20;
/// As above for an edge or a vertex, from which there are many directions.
constexpr double kClearOfEdge = 0x1p-44;

/// The place on a model's surface that is nearest to a core.
struct NearestPlace {
    std::uint32_t triangle = 0;
    bool in_face = false; ///< inside the triangle; else on an edge or a vertex
    Vec3 on_surface, on_core;
};

/// A model in the world: a surface, and with depths a solid if it is closed.
class SurfaceOrSolid {
public:
    SurfaceOrSolid(const Model& model, const Transform& world, Depths depths)
        : model_(model), world_(world) {
        // Whether a model is closed costs an examination the first time, so only depths ask.
        if (depths == Depths::yes && model.data().solid().closed)
            solid_.emplace(model, model.data().solid(), world);
    }

    [[nodiscard]] const PlacedSolid* solid() const { return solid_ ? &*solid_ : nullptr; }
    [[nodiscard]] bool contains(const Vec3& point) const {
        return solid_ && solid_->contains(point);
    }
    [[nodiscard]] Triangle world_triangle(std::uint32_t triangle) const {
        return model_.data().world_triangle(triangle, world_);
    }
    /// The corners of the triangles within a radius of a point.
    [[nodiscard]] std::vector<Vec3> corners_around(const Vec3& point, double radius) const {
        std::vector<Vec3> corners;
        for (const std::uint32_t triangle :
             overlapping_triangles(model_, world_, Sphere{point, radius}))
            for (const Vec3& corner : world_triangle(triangle))
                corners.push_back(corner);
        return corners;
    }
    /// The unit normal of a triangle, out of a solid; zero if the triangle has no area.
    [[nodiscard]] Vec3 outward_normal(std::uint32_t triangle) const {
        const Triangle t = world_triangle(triangle);
        const Vec3 normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
        if (!solid_ || normal == Vec3{})
            return normal;
        if (solid_->outward() != 0)
            return solid_->outward() < 0 ? -normal : normal;
        // The triangles are not oriented alike: a point beside this one decides.
        return solid_->contains(face_probe(t).over) ? -normal : normal;
    }

private:
    const Model& model_;
    const Transform& world_;
    std::optional<PlacedSolid> solid_;
};

/// Bound of the coordinates that a place was computed from.
double size_at(const SurfaceOrSolid& body, const NearestPlace& place) {
    double size = magnitude(place.on_core);
    for (const Vec3& corner : body.world_triangle(place.triangle))
        size = std::max(size, magnitude(corner));
    return size;
}

/// The direction from the nearest place on the surface to the core, across the edges and faces that
/// the place lies on: near it, no point of the surface is nearer to the core.
///
/// In          axis: as way_out.
Vec3 way_to_core(const SurfaceOrSolid& body, const NearestPlace& place, const Vec3& axis,
                 double size) {
    const Vec3 way = place.on_core - place.on_surface;
    const double rounding = kCoreRounding * size;
    if (length(way) > kTellsDirection * size)
        return normalized_or_zero(way);
    const double tilt = 8 * rounding / length(way);
    const Vec3 start = normalized_or_zero(way);
    std::vector<Vec3> reaches;
    for (const Vec3& corner : body.corners_around(place.on_surface, 4 * length(way)))
        // A corner that rises more belongs to another part of the surface, on the core's side.
        if (const Vec3 from = corner - place.on_surface; dot(from, start) <= tilt * length(from))
            reaches.push_back(from);
    const auto beyond_place = [&](const Vec3& n) {
        Vec3 beyond;
        for (const Vec3& from : reaches)
            if (dot(from, n) > dot(beyond, n))
                beyond = from;
        return beyond;
    };
    const auto before_core = [&](const Vec3& n) { return dot(axis, n) < 0 ? -axis : axis; };
    return supporting_normal(way, rounding, beyond_place, before_core);
}

/// The unit vector along which a core leaves the surface at its nearest place.
///
/// In          axis: of a capsule whose inside is nearest; else zero. The direction is across it.
///             inside: the core lies in the closed model.
Vec3 way_out(const SurfaceOrSolid& body, const NearestPlace& place, const Vec3& axis, bool inside) {
    const Vec3 way = place.on_core - place.on_surface, outward = inside ? -way : way;
    const double distance = length(way), size = size_at(body, place);
    if (distance > (place.in_face ? kClearOfFace : kClearOfEdge) * size) {
        const Vec3 to_core = way_to_core(body, place, axis, size);
        return inside ? -to_core : to_core;
    }
    Vec3 normal = body.outward_normal(place.triangle);
    const Vec3 along = normalized_or_zero(axis);
    if (along != Vec3{} && normal != Vec3{}) {
        const Vec3 across = normal - dot(normal, along) * along;
        normal = length(across) > 0x1p-20 ? normalized_or_zero(across) : perpendicular(along);
    }
    if (normal == Vec3{})
        return outward != Vec3{} ? normalized_or_zero(outward) : Vec3{0, 0, 1};
    return body.solid() == nullptr && dot(normal, way) < 0 ? -normal : normal;
}

/// A gap from the place on the surface to a point of the core, and a radius beyond.
BodyGap gap_with_radius(const NearestPlace& place, const Vec3& normal, double distance,
                        double radius) {
    BodyGap gap;
    gap.distance = distance - radius;
    gap.normal = normal;
    gap.point_a = place.on_surface, gap.point_b = place.on_core - radius * normal;
    gap.triangle_a = place.triangle;
    return gap;
}

/// The gap of a core that does not cross the surface.
BodyGap gap_beside(const SurfaceOrSolid& body, const NearestPlace& place, const Vec3& axis,
                   double distance, double radius, Depths depths) {
    const bool inside = body.contains(place.on_core);
    BodyGap gap = gap_with_radius(place, way_out(body, place, axis, inside),
                                  inside ? -distance : distance, radius);
    if (depths == Depths::yes) // the bodies share a point, whatever rounding says
        gap.distance = std::min(gap.distance, 0.0);
    return gap;
}

/// The model of a segment: one triangle without area.
Model model_of_segment(const Segment& segment) {
    return Model(Mesh{{segment.a, segment.b}, {{0, 1, 1}}});
}

/// Returns whether the point of a capsule's surface that is `out` behind a point of its axis lies on
/// the surface: at an end, behind which the capsule ends, or straight across the axis.
bool is_on_capsule(const Segment& axis, const Vec3& point, const Vec3& out) {
    // The square of this slope is below rounding.
    constexpr double kAcross = 0x1p-26;
    const Vec3 along = normalized_or_zero(axis.b - axis.a);
    const double slope = dot(out, along);
    const double to_end = length(point - (slope < 0 ? axis.b : axis.a));
    return std::abs(slope) <= kAcross || to_end <= kCoreRounding * magnitude(point);
}

/// The depth of the axis of a capsule in a closed model, and its radius. None if no point of the
/// axis lies inside, to rounding; or if the deepest point is where the axis passes between two
/// faces, across neither: then no point of the capsule's surface is that deep.
///
/// Out         is_inside: a point of the axis lies inside.
std::optional<BodyGap> gap_of_deepest(const SurfaceOrSolid& body, const Capsule& capsule,
                                      bool& is_inside) {
    if (body.solid() == nullptr)
        return std::nullopt;
    const Model axis = model_of_segment(capsule.axis);
    DepthSearch search;
    search.relative_error = 0x1p-40;
    const std::uint32_t only = 0;
    const DeepestPoint deepest =
        find_deepest_point(PlacedModel(axis, {}), *body.solid(), {&only, 1}, {}, search, 0);
    is_inside = deepest.depth > kCoreRounding * magnitude(deepest.on_surface);
    if (!is_inside)
        return std::nullopt;
    const NearestPlace place{deepest.solid_triangle, false, deepest.on_solid, deepest.on_surface};
    const Vec3 out = normalized_or_zero(deepest.on_solid - deepest.on_surface);
    if (!is_on_capsule(capsule.axis, deepest.on_surface, out))
        return std::nullopt;
    BodyGap gap = gap_with_radius(place, out, -deepest.depth, capsule.radius);
    const bool is_reached = deepest.at_most <= deepest.depth * (1 + 0x1p-30);
    gap.status = is_reached ? Status::exact : Status::bound_only;
    return gap;
}

/// The gap of a capsule whose axis only touches the surface. The normal is that of a triangle there:
/// outward if the capsule lies there, else inward.
BodyGap gap_of_touching(const SurfaceOrSolid& body, const Capsule& capsule,
                        const std::vector<std::uint32_t>& touched) {
    const Vec3 along = capsule.axis.b - capsule.axis.a;
    const Triangle axis{capsule.axis.a, capsule.axis.b, capsule.axis.b};
    BodyGap gap;
    for (const bool outward : {true, false})
        for (const std::uint32_t triangle : touched) {
            const ClosestPoints points =
                triangle_triangle_distance(body.world_triangle(triangle), axis);
            const NearestPlace place{triangle, points.on_a.kind == Feature::face, points.a,
                                     points.b};
            const bool in_axis = points.on_b.kind != Feature::vertex;
            const Vec3 normal = way_out(body, place, in_axis ? along : Vec3{}, false);
            gap = gap_with_radius(place, outward ? normal : -normal, 0, capsule.radius);
            if (is_on_capsule(capsule.axis, points.b, gap.normal))
                return gap;
        }
    return gap;
}

/// The gap of a capsule whose axis meets the surface: its depth in the triangle that it must leave the
/// farthest. The shortest way of a capsule out of a triangle is that of its axis, and the radius.
BodyGap gap_of_crossing(const SurfaceOrSolid& body, const Capsule& capsule,
                        const std::vector<std::uint32_t>& crossed) {
    const Triangle axis{capsule.axis.a, capsule.axis.b, capsule.axis.b};
    TriangleSeparation deepest;
    std::uint32_t triangle = crossed.front();
    for (const std::uint32_t each : crossed) {
        const TriangleSeparation found =
            triangle_triangle_penetration(body.world_triangle(each), axis);
        if (found.depth > deepest.depth)
            deepest = found, triangle = each;
    }
    const double size = magnitude(capsule.axis.a) + magnitude(capsule.axis.b);
    if (!(deepest.depth > kCoreRounding * size))
        return gap_of_touching(body, capsule, crossed);
    const Vec3 way = deepest.depth * deepest.direction;
    const Triangle moved{axis[0] + way, axis[1] + way, axis[2] + way};
    const ClosestPoints points = triangle_triangle_distance(body.world_triangle(triangle), moved);
    const NearestPlace place{triangle, points.on_a.kind == Feature::face, points.a, points.b - way};
    BodyGap gap = gap_with_radius(place, deepest.direction, -deepest.depth, capsule.radius);
    gap.status = Status::bound_only;
    return gap;
}

BodyGap beyond_bound(double distance) {
    BodyGap gap;
    gap.distance = distance;
    gap.status = Status::bound_only;
    return gap;
}

/// Enlarged to cover the rounding when the radius is subtracted again.
double bound_of_core(double upper_bound, double radius) {
    return (std::max(upper_bound, 0.0) + radius) * (1 + 0x1p-50);
}

} // namespace

BodyGap ball_gap(const Model& model, const Transform& world_from_model, const Sphere& ball,
                 double upper_bound, Depths depths) {
    NearestOptions options;
    options.upper_bound = bound_of_core(upper_bound, ball.radius);
    const Nearest found = nearest(model, world_from_model, ball.centre, options);
    if (found.status == Status::bound_only)
        return beyond_bound(found.distance - ball.radius);
    const NearestPlace place{found.triangle, found.feature == Feature::face, found.point,
                             ball.centre};
    return gap_beside(SurfaceOrSolid(model, world_from_model, depths), place, {}, found.distance,
                      ball.radius, depths);
}

BodyGap capsule_gap(const Model& model, const Transform& world_from_model, const Capsule& capsule,
                    double upper_bound, Depths depths) {
    DistanceOptions options;
    options.upper_bound = bound_of_core(upper_bound, capsule.radius);
    const Gap found = distance(model, world_from_model, capsule.axis, options);
    if (found.status == Status::bound_only)
        return beyond_bound(found.distance - capsule.radius);
    const SurfaceOrSolid body(model, world_from_model, depths);
    const NearestPlace place{found.triangle_a, found.feature_a == Feature::face, found.point_a,
                             found.point_b};
    const bool in_axis = found.feature_b != Feature::vertex;
    const Vec3 along = in_axis ? capsule.axis.b - capsule.axis.a : Vec3{};
    if (depths == Depths::no)
        return gap_beside(body, place, along, found.distance, capsule.radius, depths);
    bool is_inside = false;
    if (const std::optional<BodyGap> deepest = gap_of_deepest(body, capsule, is_inside))
        return *deepest;
    // Where the distance is rounding, several triangles may be the nearest.
    const double doubt = kClearOfEdge * size_at(body, place);
    BodyGap gap;
    if (const auto crossed = overlapping_triangles(model, world_from_model, capsule.axis);
        !crossed.empty())
        gap = gap_of_crossing(body, capsule, crossed);
    else if (found.distance <= doubt)
        gap = gap_of_touching(
            body, capsule,
            overlapping_triangles(model, world_from_model, Sphere{found.point_b, 2 * doubt}));
    else // the axis leaves the surface on its side
        gap = gap_beside(SurfaceOrSolid(model, world_from_model, Depths::no), place, along,
                         found.distance, capsule.radius, depths);
    if (is_inside)
        gap.status = Status::bound_only;
    return gap;
}

} // namespace abut
