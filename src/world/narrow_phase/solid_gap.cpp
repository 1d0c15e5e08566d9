#include "world/narrow_phase/solid_gap.h"

#include "convex/body/convex_data.h"
#include "convex/support/support_gap.h"
#include "math/transform.h"
#include "rigid/model/placed_model.h"
#include "world/narrow_phase/parting_motion.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

BodyGap gap_of(const SupportGap& found) {
    BodyGap gap;
    gap.distance = found.distance, gap.normal = found.normal;
    gap.point_a = found.point_a, gap.point_b = found.point_b;
    gap.status = found.bounds_agree ? Status::exact : Status::bound_only;
    return gap;
}

/// Finds the triangle that is nearest to a solid, or deepest in it.
class NearestTriangle {
public:
    NearestTriangle(const PlacedModel& model, const SupportShape& solid, double upper_bound,
                    Depths depths)
        : model_(model), solid_(solid), depths_(depths) {
        best_.distance = upper_bound;
        best_.status = Status::bound_only;
    }

    BodyGap find() {
        const double reach = solid_.reach + solid_.radius;
        model_.for_each_near(solid_.centre, square(best_.distance + reach),
                             [&](std::uint32_t slot) {
                                 try_triangle(slot);
                                 if (best_.distance <= 0 && depths_ == Depths::no)
                                     return kStopTraversal;
                                 return square(std::max(best_.distance, 0.0) + reach);
                             });
        return best_;
    }

private:
    static double square(double length) { return length * length * (1 + 0x1p-40); }

    void try_triangle(std::uint32_t slot) {
        const SupportShape triangle = support_of(model_.world_slot(slot));
        if (direction_ != Vec3{} && separation_along(triangle, solid_, direction_) > best_.distance)
            return;
        // Each depth is a bound by itself, so that a limit keeps the result valid.
        constexpr std::uint32_t kMostDepths = 256;
        const bool deep = depths_ == Depths::yes && depths_found_ < kMostDepths;
        const SupportGap gap =
            support_gap(triangle, solid_, best_.distance,
                        deep ? SupportDepths::bound : SupportDepths::no, direction_);
        depths_found_ += gap.distance < 0 ? 1 : 0;
        const std::uint32_t number = model_.data().triangle_at(slot);
        const bool lower = number < best_.triangle_a;
        if (gap.distance > best_.distance ||
            (gap.distance == best_.distance && (best_.status == Status::bound_only || !lower)))
            return;
        best_ = gap_of(gap);
        best_.triangle_a = number;
        // The points are those of a motion that separates, the depth is a lower bound: the point as
        // deep as that below the triangle's is in the solid too.
        if (gap.distance < 0 && !gap.bounds_agree)
            best_.point_b = best_.point_a + best_.distance * best_.normal;
    }

    const PlacedModel& model_;
    const SupportShape& solid_;
    Depths depths_;
    Vec3 direction_; ///< that of the last triangle. It only serves to skip triangles.
    std::uint32_t depths_found_ = 0;
    BodyGap best_;
};

} // namespace

SupportShape support_of(const ConvexShape& convex, const Transform& world_from_body) {
    const ConvexData& data = convex.solid.data();
    const auto& m = world_from_body.m;
    SupportShape shape;
    shape.kind = CoreKind::polytope;
    shape.polytope = &data.levels.front().polytope;
    shape.columns = {Vec3{m[0], m[1], m[2]}, Vec3{m[3], m[4], m[5]}, Vec3{m[6], m[7], m[8]}};
    shape.first = shape.polytope->vertices.front().at;
    shape.centre = apply(world_from_body, shape.first);
    for (const HullVertex& vertex : shape.polytope->vertices)
        shape.reach = std::max(shape.reach, length_sq(vertex.at - shape.first));
    shape.reach = std::sqrt(shape.reach) * (1 + 0x1p-40);
    return shape;
}

SupportShape support_of(const RoundedBox& solid) {
    SupportShape shape;
    shape.kind = CoreKind::box;
    shape.centre = solid.centre, shape.axis = solid.axis, shape.half = solid.half;
    shape.radius = solid.radius;
    shape.reach = length(Vec3{solid.half[0], solid.half[1], solid.half[2]}) * (1 + 0x1p-40);
    return shape;
}

std::optional<SupportShape> support_of(const PlacedBody& body) {
    if (const auto* convex = std::get_if<ConvexShape>(&body.shape))
        return support_of(*convex, body.world_from_body);
    if (const auto* box = std::get_if<RoundedBox>(&body.shape))
        return support_of(placed(*box, body.world_from_body));
    if (const auto* curved = std::get_if<CurvedShape>(&body.shape))
        return placed(*curved, body.world_from_body);
    return std::nullopt;
}

Box3 box_around(const SupportShape& solid) {
    const double by =
        (solid.reach + solid.radius) * (1 + 0x1p-40) + 0x1p-40 * max_abs(solid.centre);
    return grown(Box3{solid.centre, solid.centre}, by);
}

BodyGap solid_gap(const SupportShape& a, const SupportShape& b, double upper_bound,
                  Vec3& direction) {
    return gap_of(support_gap(a, b, upper_bound, SupportDepths::yes, direction));
}

BodyGap solid_gap(const SupportShape& a, const PlaneShape& plane) {
    const Vec3& n = plane.normal;
    const Vec3 lowest = farthest(a, -n);
    BodyGap gap;
    gap.distance = dot(n, a.centre - plane.point) + dot(n, lowest) - a.radius;
    gap.point_a = a.centre + lowest - a.radius * n;
    gap.point_b = gap.point_a - gap.distance * n;
    gap.normal = -n;
    return gap;
}

BodyGap solid_gap(const PlaneShape& a, const PlaneShape& b) {
    BodyGap gap;
    gap.point_a = gap.point_b = a.point;
    gap.distance = -kNowhere;
    gap.status = Status::bound_only;
    if (a.normal != -b.normal)
        return gap;
    gap.distance = dot(a.normal, b.point - a.point);
    gap.point_b = a.point + gap.distance * a.normal;
    gap.normal = a.normal;
    gap.status = Status::exact;
    return gap;
}

bool surface_meets(const Model& model, const Transform& world_from_model, const SupportShape& solid,
                   double touching) {
    const PlacedModel placed_model(model, world_from_model);
    bool meet = false;
    Vec3 direction;
    placed_model.for_each_overlap(grown(box_around(solid), touching), [&](std::uint32_t slot) {
        meet = meet || support_gap(support_of(placed_model.world_slot(slot)), solid, touching,
                                   SupportDepths::no, direction)
                               .distance <= touching;
    });
    return meet;
}

void part_from_surface(BodyGap& gap, const PlacedModel& model, const SupportShape& solid) {
    // Some roundings of a place in the world, and of one on the model.
    const double touching =
        0x1p-45 * (max_abs(solid.centre) + solid.reach + solid.radius + model.reach());
    if (gap.distance > touching)
        return;
    const PartingMotion of_one{gap.normal, std::max(-gap.distance, 0.0), gap.point_b,
                               gap.triangle_a};
    const auto motion = find_parting_motion(model, solid, of_one, touching);
    if (!motion)
        return;
    gap.distance = -motion->length, gap.normal = motion->direction;
    gap.point_b = motion->point;
    gap.point_a = motion->point + motion->length * motion->direction;
    gap.triangle_a = motion->triangle;
    gap.status = Status::bound_only;
}

bool is_in_open(const BodyGap& gap, const Model& model, Depths depths) {
    return depths == Depths::yes && gap.distance <= 0 && !model.data().solid().closed;
}

BodyGap surface_gap(const Model& model, const Transform& world_from_model,
                    const SupportShape& solid, double upper_bound, Depths depths) {
    const PlacedModel placed_model(model, world_from_model);
    BodyGap gap = NearestTriangle(placed_model, solid, upper_bound, depths).find();
    if (gap.distance <= 0 && depths == Depths::yes)
        gap.status = Status::bound_only;
    if (depths == Depths::yes)
        part_from_surface(gap, placed_model, solid);
    if (gap.distance < 0 && depths == Depths::no) // how deep they meet was not asked
        gap.distance = 0, gap.normal = {}, gap.point_b = gap.point_a;
    return gap;
}

BodyGap surface_gap(const Model& model, const Transform& world_from_model,
                    const PlaneShape& plane) {
    const PlacedModel placed_model(model, world_from_model);
    const Vec3& n = plane.normal;
    BodyGap gap;
    gap.distance = kNowhere, gap.normal = -n;
    const double reach = 2 * placed_model.reach() + 0x1p-20 * max_abs(placed_model.middle());
    const Box3 all = grown(Box3{placed_model.middle(), placed_model.middle()}, reach);
    placed_model.for_each_overlap_outside(all, [&](std::uint32_t slot) {
        for (const Vec3& corner : placed_model.world_slot(slot)) {
            const double height = dot(n, corner - plane.point);
            if (height >= gap.distance)
                continue;
            gap.distance = height, gap.point_a = corner;
            gap.triangle_a = placed_model.data().triangle_at(slot);
        }
        return PlacedModel::HalfSpace{gap.point_a, n};
    });
    gap.point_b = gap.point_a - gap.distance * n;
    return gap;
}

} // namespace abut
