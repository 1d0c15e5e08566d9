#include "deform/bodies/body_gap.h"

#include <abut/shape_queries.h>

#include "convex/support/support_gap.h"
#include "deform/bodies/deepest_place.h"
#include "deform/bodies/inner_planes.h"
#include "deform/bodies/model_triangles.h"
#include "deform/bodies/way_out.h"
#include "geometry/point_triangle_distance.h"
#include "geometry/triangle_triangle_distance.h"
#include "rigid/model/model_data.h"
#include "world/narrow_phase/solid_gap.h"
#include "world/queries/rigid_shape_data.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <variant>

namespace abut {

namespace {

/// Points that are nearer than this share of their coordinates differ by rounding alone.
constexpr double kTellsNoDirection = 0x1p-44;

/// A convex body.
class SolidGaps final : public BodyGaps {
public:
    /// In: convex, the data of a `Convex`, which must outlive this; else null.
    SolidGaps(const Box3& bounds, const SupportShape& solid, const ConvexData* convex)
        : BodyGaps(bounds), solid_(with_largest_radius(solid)), shape_(solid), convex_(convex) {}

    [[nodiscard]] std::optional<PlaceNearBody> of_point(const Vec3& point,
                                                        double limit) const override {
        if (const auto inside = inside_planes(point))
            return inside;
        SupportShape shape;
        shape.centre = point;
        return place(shape, limit, SupportDepths::yes);
    }
    [[nodiscard]] std::optional<PlaceNearBody> of_triangle(const Triangle& triangle,
                                                           double limit) const override {
        auto shortest = place(support_of(triangle), limit, SupportDepths::no);
        if (!shortest || shortest->distance > 0)
            return shortest;
        double size = 0;
        for (const Vec3& corner : triangle)
            size = std::max(size, max_abs(corner - shortest->point));
        const double tolerance = 0x1p-44 * size;
        if (planes() != nullptr) {
            // The common point of both may be off the triangle.
            const Vec3 start = nearest_on_triangle(shortest->point, triangle).point;
            const Vec3 place = deepest_place(
                triangle, start, [&](const Vec3& p) { return by_planes(p); }, tolerance);
            if (const auto inside = inside_planes(place))
                return inside;
        }
        shortest = place(support_of(triangle), limit, SupportDepths::yes);
        return shortest && shortest->distance < 0 ? deepest(triangle, *shortest, limit, tolerance)
                                                  : shortest;
    }

private:
    [[nodiscard]] std::optional<PlaceNearBody> place(const SupportShape& shape, double limit,
                                                     SupportDepths depths) const {
        Vec3 direction;
        const SupportGap gap = support_gap(shape, solid_, limit, depths, direction);
        if (gap.distance > limit)
            return std::nullopt;
        return PlaceNearBody{gap.distance, gap.point_a, gap.point_b, -gap.normal, 0};
    }
    /// The body's supporting planes; null if it has no such (see make_inner_planes).
    [[nodiscard]] const InnerPlanes* planes() const {
        std::call_once(planes_once_, [&] { planes_ = make_inner_planes(shape_, convex_); });
        return planes_.get();
    }
    [[nodiscard]] ConvexSample by_planes(const Vec3& point) const {
        const Vec3 from_centre = point - shape_.centre;
        const SupportingPlane plane = planes_->nearest(from_centre);
        return {dot(plane.normal, from_centre) - plane.offset, plane.normal};
    }
    /// The place of a point that is inside by more than rounding, if the body's planes are known.
    [[nodiscard]] std::optional<PlaceNearBody> inside_planes(const Vec3& point) const {
        if (!overlap(Box3{point, point}, bounds()) || planes() == nullptr)
            return std::nullopt;
        const auto [distance, normal] = by_planes(point);
        if (!(distance < -kTellsNoDirection * (max_abs(point) + max_abs(shape_.centre))))
            return std::nullopt;
        return PlaceNearBody{distance, point, point - distance * normal, normal, 0};
    }
    /// The deepest point, for a body whose planes are not known. A motion that parts the whole
    /// triangle from the body is no shorter than one that brings any point of it out. Both are
    /// equal unless the triangle passes through the body.
    [[nodiscard]] std::optional<PlaceNearBody> deepest(const Triangle& triangle,
                                                       const PlaceNearBody& shortest, double limit,
                                                       double tolerance) const {
        constexpr double kAnyDistance = std::numeric_limits<double>::infinity();
        auto deepest = of_point(shortest.point, kAnyDistance);
        if (deepest->distance > shortest.distance + tolerance) {
            const auto sample = [&](const Vec3& point) {
                const auto at = of_point(point, kAnyDistance);
                return ConvexSample{at->distance, at->normal};
            };
            deepest =
                of_point(deepest_place(triangle, shortest.point, sample, tolerance), kAnyDistance);
        }
        return deepest->distance <= limit ? deepest : std::nullopt;
    }

    SupportShape solid_; ///< for gaps
    SupportShape shape_; ///< for planes
    const ConvexData* convex_;
    mutable std::once_flag planes_once_;
    mutable std::unique_ptr<const InnerPlanes> planes_;
};

/// A ball or a capsule, in closed form: all points near a point or a segment, its core.
class RoundGaps final : public BodyGaps {
public:
    /// In: solid, for which has_line_core is true.
    RoundGaps(const Box3& bounds, const SupportShape& solid)
        : BodyGaps(bounds), radius_(solid.radius) {
        const std::size_t longest = static_cast<std::size_t>(
            std::max_element(solid.half.begin(), solid.half.end()) - solid.half.begin());
        const Vec3 half = solid.half[longest] * solid.axis[longest];
        a_ = solid.centre - half, b_ = solid.centre + half;
        axis_ = normalized_or_zero(half);
    }
    static bool has_line_core(const SupportShape& solid) {
        return solid.kind == CoreKind::box &&
               std::count(solid.half.begin(), solid.half.end(), 0.0) >= 2;
    }

    [[nodiscard]] std::optional<PlaceNearBody> of_point(const Vec3& point,
                                                        double limit) const override {
        const Vec3 side = b_ - a_;
        const double square = dot(side, side);
        const double along = square > 0 ? std::clamp(dot(point - a_, side) / square, 0.0, 1.0) : 0;
        return place(point, a_ + along * side, perpendicular(axis_), limit);
    }
    [[nodiscard]] std::optional<PlaceNearBody> of_triangle(const Triangle& triangle,
                                                           double limit) const override {
        const ClosestPoints closest = triangle_triangle_distance(triangle, {a_, b_, b_});
        const Vec3 across = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
        return place(closest.a, closest.b, across, limit);
    }

private:
    /// In: core, the core's point that is nearest to the point; across, the normal where both are the
    /// same to rounding, of any length. It is made perpendicular to the axis.
    [[nodiscard]] std::optional<PlaceNearBody> place(const Vec3& point, const Vec3& core,
                                                     const Vec3& across, double limit) const {
        Vec3 normal = point - core;
        const double from_core = length(normal);
        if (from_core - radius_ > limit)
            return std::nullopt;
        if (from_core > kTellsNoDirection * (max_abs(point) + max_abs(core))) {
            normal = (1 / from_core) * normal;
        } else {
            constexpr double kParallel = 0x1p-26;
            normal = across - dot(across, axis_) * axis_;
            if (length(normal) > kParallel * length(across))
                normal = normalized_or_zero(normal);
            else
                normal = axis_ == Vec3{} ? Vec3{0, 0, 1} : perpendicular(axis_);
        }
        return PlaceNearBody{from_core - radius_, point, core + radius_ * normal, normal, 0};
    }

    Vec3 a_, b_, axis_; ///< the core's ends; the axis is zero for a ball
    double radius_;
};

/// A half-space. Its distance is linear, so a triangle's vertices tell all.
class HalfSpaceGaps final : public BodyGaps {
public:
    HalfSpaceGaps(const Box3& bounds, const PlaneShape& plane) : BodyGaps(bounds), plane_(plane) {}

    [[nodiscard]] std::optional<PlaceNearBody> of_point(const Vec3& point,
                                                        double limit) const override {
        const double distance = dot(plane_.normal, point - plane_.point);
        if (distance > limit)
            return std::nullopt;
        return PlaceNearBody{distance, point, point - distance * plane_.normal, plane_.normal, 0};
    }
    [[nodiscard]] std::optional<PlaceNearBody> of_triangle(const Triangle& /*triangle*/,
                                                           double /*limit*/) const override {
        return std::nullopt;
    }

private:
    PlaneShape plane_;
};

class ModelGaps final : public BodyGaps {
public:
    ModelGaps(const Box3& bounds, const Model& model, const Transform& world_from_model)
        : BodyGaps(bounds), model_(model), world_(world_from_model),
          triangles_(model, world_from_model) {
        const Solid& solid = model.data().solid();
        is_solid_ = solid.closed && solid.open.empty();
    }

    [[nodiscard]] std::optional<PlaceNearBody> of_point(const Vec3& point,
                                                        double limit) const override {
        // The bound must be above the limit, since what is as far as the bound is not found. Its
        // square must not be 0.
        const double bound = limit + 0x1p-40 * (limit + max_abs(point)) + 0x1p-500;
        NearestOptions options{.upper_bound = bound, .signed_distance = is_solid_};
        Nearest found = nearest(model_, world_, point, options);
        if (found.status == Status::bound_only && found.distance < 0) {
            options.upper_bound = std::numeric_limits<double>::infinity();
            found = nearest(model_, world_, point, options);
        }
        if (found.status == Status::bound_only || found.distance > limit)
            return std::nullopt;
        return place(found.distance, point, found.point, found.triangle);
    }
    [[nodiscard]] std::optional<PlaceNearBody> of_triangle(const Triangle& triangle,
                                                           double limit) const override {
        const auto found = triangles_.nearest_to(triangle, limit);
        if (!found)
            return std::nullopt;
        const ClosestPoints& closest = found->closest;
        const double distance = std::sqrt(closest.distance_sq);
        // In a solid, the deepest vertex counts. What touches the boundary to rounding is not inside.
        if (distance > kTellsNoDirection * (max_abs(closest.a) + max_abs(closest.b)) && is_solid_ &&
            contains(model_, world_, closest.a).side == Side::inside)
            return std::nullopt;
        return place(distance, closest.a, closest.b, found->triangle);
    }

private:
    /// In: a signed distance.
    [[nodiscard]] PlaceNearBody place(double distance, const Vec3& point, const Vec3& on_body,
                                      std::uint32_t triangle) const {
        const Vec3 between = point - on_body;
        const double rounding = kTellsNoDirection * (max_abs(point) + max_abs(on_body));
        const Vec3 normal = length(between) <= rounding
                                ? normal_of_touch(on_body, rounding, triangle)
                                : normalized_or_zero(distance < 0 ? -between : between);
        return {distance, point, on_body, normal, triangle};
    }
    /// The way out of all triangles at a place. At a re-entrant edge, the normal of one of them may
    /// lead into the others. Where none leads out, that of the given triangle.
    [[nodiscard]] Vec3 normal_of_touch(const Vec3& at, double rounding,
                                       std::uint32_t triangle) const {
        boost::container::small_vector<Vec3, 16> normals;
        const double reach = 2 * rounding;
        triangles_.placed().for_each_overlap(grown(Box3{at, at}, reach), [&](std::uint32_t slot) {
            const Triangle t = triangles_.placed().world_slot(slot);
            if (!(nearest_on_triangle(at, t).distance_sq <= reach * reach))
                return;
            const Vec3 out = outward(t, triangles_.placed().data().triangle_at(slot));
            if (out != Vec3{})
                normals.push_back(out);
        });
        const Vec3 way = way_out({normals.data(), normals.size()});
        if (way != Vec3{})
            return way;
        const Triangle t = model_.data().world_triangle(triangle, world_);
        const Vec3 out = outward(t, triangle);
        return out != Vec3{} ? out : perpendicular(t[1] - t[0]);
    }
    /// The normal of a triangle out of the solid, if it bounds one; zero without area.
    [[nodiscard]] Vec3 outward(const Triangle& t, std::uint32_t number) const {
        const Vec3 across = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
        const Solid& solid = model_.data().solid();
        return is_solid_ && solid.is_oriented() && solid.weight(number) < 0 ? -across : across;
    }

    const Model& model_;
    Transform world_;
    ModelTriangles triangles_;
    bool is_solid_ = false;
};

} // namespace

std::unique_ptr<const BodyGaps> make_body_gaps(const RigidShape& body,
                                               const Transform& world_from_body) {
    const RigidShapeData& data = body.data();
    const Box3 bounds = bounds_of(data.shape, data.own_bounds, world_from_body);
    if (const auto* model = std::get_if<Model>(&data.shape))
        return std::make_unique<ModelGaps>(bounds, *model, world_from_body);
    if (const auto* plane = std::get_if<PlaneShape>(&data.shape))
        return std::make_unique<HalfSpaceGaps>(bounds, placed(*plane, world_from_body));
    const SupportShape shape = *support_of({data.shape, world_from_body});
    if (const SupportShape solid = with_largest_radius(shape); RoundGaps::has_line_core(solid))
        return std::make_unique<RoundGaps>(bounds, solid);
    const auto* convex = std::get_if<ConvexShape>(&data.shape);
    return std::make_unique<SolidGaps>(bounds, shape,
                                       convex != nullptr ? &convex->solid.data() : nullptr);
}

} // namespace abut
