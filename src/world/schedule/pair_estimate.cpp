#include "world/schedule/pair_estimate.h"

#include "convex/support/support_gap.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/transform.h"
#include "rigid/model/model_data.h"
#include "rigid/pair/separating_plane.h"
#include "world/narrow_phase/offset_surface.h"
#include "world/narrow_phase/solid_gap.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// A measurement pays if it saves at least this many tests for contact.
constexpr double kMeasureWorth = 8;
/// Longest pause between two measurements that do not pay, in tests.
constexpr std::uint8_t kLongestIdle = 127;
/// Error allowed to the distance of two surfaces.
constexpr double kCoarse = 0.5;
/// Rounding of the witness points of two solids, relative to the coordinates.
constexpr double kTiltRounding = 0x1p-48;
/// Error of the distance of a curved shape, relative to the coordinates.
constexpr double kCurvedGapRounding = 0x1p-38;

OffsetSurface surface_now(const BodyShape& shape) {
    if (const auto* deformable = std::get_if<DeformableShape>(&shape))
        return {deformable->snapshot->model(), {}, 0};
    return offset_surface_of(shape);
}

/// One estimate of a pair.
class Estimator {
public:
    Estimator(const PairNow& pair, PairMemory& memory)
        : pair_(pair), memory_(memory),
          size_(max_abs(pair.box_a.lower) + max_abs(pair.box_a.upper) + max_abs(pair.box_b.lower) +
                max_abs(pair.box_b.upper) + pair.motion.a.reach + pair.motion.b.reach),
          margin_(kScheduleRounding * size_) {}

    [[nodiscard]] double of_balls() const {
        const auto &a = pair_.a.world_from_body.m, &b = pair_.b.world_from_body.m;
        return time_of_balls(pair_.motion, Vec3{a[9], a[10], a[11]} - Vec3{b[9], b[10], b[11]},
                             size_);
    }

    /// The bodies meet only when their boxes overlap along all three axes.
    [[nodiscard]] double of_boxes() const {
        double latest = 0;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 n{axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
            double gap = component(pair_.box_b.lower, axis) - component(pair_.box_a.upper, axis);
            const double other =
                component(pair_.box_a.lower, axis) - component(pair_.box_b.upper, axis);
            if (other > gap)
                gap = other, n = -n;
            if (gap > margin_)
                latest = std::max(latest, time_along(pair_.motion, n, gap - margin_));
        }
        return latest;
    }

    [[nodiscard]] bool has_half_space() const {
        return is_half_space(pair_.a.shape) || is_half_space(pair_.b.shape);
    }
    /// A half-space and any body: by the body's box, if that may suffice, then exactly. One that may
    /// turn is tested in each step.
    PairEstimate of_half_space(bool box_suffices) {
        RelativeMotion motion = pair_.motion;
        bool turning = false;
        for (TurnBounds* turn : {&motion.a, &motion.b})
            if (!(turn->reach < kNoCollision)) {
                turning = turning || turn->velocity != Vec3{} || turn->speed > 0 ||
                          turn->acceleration > 0;
                turn->reach = 0;
            }
        if (box_suffices && !turning)
            if (const double free = of_box_and_plane(motion); free > 0)
                return {false, false, free};
        const BodyGap gap =
            gap_between(pair_.a, pair_.b, kNoCollision, Depths::no, memory_.warm_start);
        if (gap.distance <= 0)
            return {true, true, 0};
        const double margin = kScheduleRounding * (size_of_coordinates() + gap.distance);
        return {false, true, turning ? 0 : time_along(motion, gap.normal, gap.distance - margin)};
    }

    [[nodiscard]] bool has_curved_shape() const {
        return std::holds_alternative<CurvedShape>(pair_.a.shape) ||
               std::holds_alternative<CurvedShape>(pair_.b.shape);
    }
    [[nodiscard]] bool both_solid() const {
        return is_convex(pair_.a.shape) && is_convex(pair_.b.shape);
    }
    /// Whether neither body can lie inside the other without touching it.
    [[nodiscard]] bool both_surfaces() const {
        return !is_convex(pair_.a.shape) && !is_convex(pair_.b.shape);
    }

    double of_solids() {
        const BodyGap gap =
            gap_between(pair_.a, pair_.b, kNoCollision, Depths::no, memory_.warm_start);
        if (!(gap.distance > margin_))
            return 0;
        // The witness points are rounded. The shorter their distance, the more that tilts the normal,
        // and the solids may reach beyond the planes across a tilted normal.
        const double tilt = kTiltRounding * size_ / gap.distance;
        double along = gap.distance - tilt * size_, any = gap.distance;
        if (has_curved_shape()) { // its distances have a larger error
            along = separation_along(*support_of(pair_.a), *support_of(pair_.b), gap.normal);
            any = std::min(any - kCurvedGapRounding * size_, along);
        }
        return std::max(time_along(pair_.motion, gap.normal, along - margin_),
                        time_from_distance(pair_.motion, any - margin_));
    }

    double of_plane() {
        const OffsetSurface a = surface_now(pair_.a.shape), b = surface_now(pair_.b.shape);
        const SeparatingSlab plane =
            separation(a.surface.data(), compose(pair_.a.world_from_body, a.body_from_surface),
                       b.surface.data(), compose(pair_.b.world_from_body, b.body_from_surface),
                       memory_.direction);
        memory_.direction = plane.normal;
        return time_along(pair_.motion, plane.normal, plane.gap - a.radius - b.radius - margin_);
    }

    bool touch() { return abut::touch(pair_.a, pair_.b, memory_.warm_start); }

    /// Whether the triangles that touched at the last test still do. False proves nothing.
    [[nodiscard]] bool still_touch() const {
        const auto *a = std::get_if<Model>(&pair_.a.shape), *b = std::get_if<Model>(&pair_.b.shape);
        const WarmStart& start = memory_.warm_start.surfaces;
        if (a == nullptr || b == nullptr || !start.used ||
            start.last.a >= a->mesh().triangles.size() ||
            start.last.b >= b->mesh().triangles.size())
            return false;
        return triangle_triangle_intersect(
                   a->data().world_triangle(start.last.a, pair_.a.world_from_body),
                   b->data().world_triangle(start.last.b, pair_.b.world_from_body)) !=
               TriangleContact::none;
    }

    /// What is left of the distance that was measured last. As a sees it, no point of b has moved
    /// farther than its origin and its turn say.
    [[nodiscard]] double of_known_distance() const {
        const KnownDistance& known = memory_.known;
        if (!(known.at_least > margin_))
            return 0;
        const Transform now = a_from_b();
        double turn_sq = 0;
        for (std::size_t i = 0; i < 9; ++i) {
            const double d = now.m[i] - known.a_from_b.m[i];
            turn_sq += d * d;
        }
        const auto &to = now.m, &from = known.a_from_b.m;
        const double way = length(Vec3{to[9] - from[9], to[10] - from[10], to[11] - from[11]});
        // A difference of two rotations has two equal singular values, and the third is 0.
        const double turned = std::sqrt(0.5 * turn_sq) * pair_.motion.b.reach;
        return time_from_distance(pair_.motion, known.at_least - way - turned - 2 * margin_);
    }

    double of_surfaces(double relative_error) {
        if (has_curved_shape()) { // a surface may be nearer to the shape than to its polyhedron
            const BodyGap gap =
                gap_between(pair_.a, pair_.b, kNoCollision, Depths::no, memory_.warm_start);
            memory_.known = {gap.distance - kCurvedGapRounding * size_, a_from_b()};
            return time_from_distance(pair_.motion, memory_.known.at_least - margin_);
        }
        const OffsetSurface a = surface_now(pair_.a.shape), b = surface_now(pair_.b.shape);
        DistanceOptions options;
        options.relative_error = relative_error;
        options.warm_start = &memory_.warm_start.surfaces;
        const Gap gap =
            distance(a.surface, compose(pair_.a.world_from_body, a.body_from_surface), b.surface,
                     compose(pair_.b.world_from_body, b.body_from_surface), options);
        memory_.known = {gap.at_least - a.radius - b.radius, a_from_b()};
        return time_from_distance(pair_.motion, memory_.known.at_least - margin_);
    }

    /// Returns true only if a distance of the surfaces would prove no more than this time to be free.
    [[nodiscard]] bool surfaces_may_meet_in(double time) const {
        if (has_curved_shape())
            return false;
        const double closed = distance_closed(pair_.motion, time);
        if (!(closed < kNoCollision))
            return false;
        const OffsetSurface a = surface_now(pair_.a.shape), b = surface_now(pair_.b.shape);
        return within(a.surface, compose(pair_.a.world_from_body, a.body_from_surface), b.surface,
                      compose(pair_.b.world_from_body, b.body_from_surface),
                      closed + a.radius + b.radius);
    }

private:
    /// Of the body and the plane, where one of the two is a half-space.
    [[nodiscard]] double size_of_coordinates() const {
        double size = 0;
        for (const PlacedBody* body : {&pair_.a, &pair_.b})
            if (const auto* plane = std::get_if<PlaneShape>(&body->shape))
                size +=
                    max_abs(plane->point) + max_abs(placed(*plane, body->world_from_body).point);
        for (const Box3* box : {&pair_.box_a, &pair_.box_b})
            if (const double end = max_abs(box->lower) + max_abs(box->upper); end < kNoCollision)
                size += end;
        return size;
    }
    /// A time before which the box of one body does not reach the other's plane.
    [[nodiscard]] double of_box_and_plane(const RelativeMotion& motion) const {
        const bool is_a = is_half_space(pair_.a.shape);
        const PlacedBody& body = is_a ? pair_.a : pair_.b;
        const Box3& box = is_a ? pair_.box_b : pair_.box_a;
        const PlaneShape plane = placed(std::get<PlaneShape>(body.shape), body.world_from_body);
        const Vec3& n = plane.normal;
        const Vec3 lowest{n.x > 0 ? box.lower.x : box.upper.x, n.y > 0 ? box.lower.y : box.upper.y,
                          n.z > 0 ? box.lower.z : box.upper.z};
        if (!is_finite(lowest))
            return 0;
        const double gap = dot(n, lowest - plane.point) - kScheduleRounding * size_of_coordinates();
        return gap > 0 ? time_along(motion, is_a ? n : -n, gap) : 0;
    }
    /// Rotations are orthogonal to a few roundings, which the margin covers.
    [[nodiscard]] Transform a_from_b() const {
        const Transform &a = pair_.a.world_from_body, &b = pair_.b.world_from_body;
        Transform result;
        for (std::size_t i = 0; i < 12; i += 3) {
            Vec3 column{b.m[i], b.m[i + 1], b.m[i + 2]};
            if (i == 9)
                column = column - Vec3{a.m[9], a.m[10], a.m[11]};
            column = pull_back(a, column);
            result.m[i] = column.x, result.m[i + 1] = column.y, result.m[i + 2] = column.z;
        }
        return result;
    }

    const PairNow& pair_;
    PairMemory& memory_;
    double size_, margin_;
};

/// Surfaces whose planes do not tell them apart.
PairEstimate estimate_surfaces(Estimator& estimator, PairMemory& memory, double step,
                               std::uint8_t first_idle) {
    if (!memory.measured)
        memory.measured = true, memory.idle = memory.idle_next = first_idle;
    if (memory.idle > 0) {
        --memory.idle;
        return {estimator.touch(), true, 0};
    }
    // A distance tells surfaces apart by itself, but not a surface inside of a solid.
    if (!estimator.both_surfaces() && estimator.touch())
        return {true, true, 0};
    // After a distance that did not pay, a third of its cost tells whether the next one may.
    double free = 0;
    if (memory.idle_next == 0 || !estimator.surfaces_may_meet_in(kMeasureWorth * step))
        free = estimator.of_surfaces(kCoarse);
    if (!(free > 0) && estimator.touch())
        return {true, true, 0};
    const bool pays = free >= kMeasureWorth * step;
    memory.idle_next = pays ? 0 : std::min<std::uint8_t>(kLongestIdle, 2 * memory.idle_next + 1);
    memory.idle = memory.idle_next;
    return {false, true, free, pays ? Measurement::paid : Measurement::wasted};
}

} // namespace

PairEstimate estimate(const PairNow& pair, PairMemory& memory, double step,
                      std::uint8_t first_idle) {
    Estimator estimator(pair, memory);
    if (memory.touched) {
        if (estimator.still_touch())
            return {true, true, 0};
        memory.warm_start.surfaces.used = false; // those triangles need no other test
        if (estimator.touch())
            return {true, true, 0};
        memory.touched = false;
    }
    if (estimator.has_half_space()) {
        const PairEstimate result = estimator.of_half_space(true);
        memory.touched = result.touch;
        return result;
    }
    const bool idle = memory.idle > 0;
    double free =
        idle ? estimator.of_boxes() : std::max(estimator.of_balls(), estimator.of_boxes());
    if (free > 0)
        return {false, false, free};
    // The surfaces are near: no plane parted them at the last measurement, which did not pay.
    if (idle) {
        const PairEstimate result = estimate_surfaces(estimator, memory, step, first_idle);
        memory.touched = result.touch;
        return result;
    }
    free = estimator.of_known_distance();
    if (free > step)
        return {false, false, free};
    const bool solids = estimator.both_solid();
    const double of_plane = solids ? estimator.of_solids() : estimator.of_plane();
    if (of_plane > 0)
        return {false, solids, std::max(free, of_plane)};
    const PairEstimate result = solids ? PairEstimate{estimator.touch(), true, 0}
                                       : estimate_surfaces(estimator, memory, step, first_idle);
    memory.touched = result.touch;
    return result;
}

PairEstimate best_estimate(const PairNow& pair, PairMemory& memory) {
    Estimator estimator(pair, memory);
    if (estimator.has_half_space())
        return estimator.of_half_space(false);
    double free = std::max(estimator.of_balls(), estimator.of_boxes());
    if (free == kNoCollision)
        return {false, false, free};
    if (!(free > 0) && estimator.touch())
        return {true, true, 0};
    const bool solids = estimator.both_solid();
    free = std::max(free, solids ? estimator.of_solids() : estimator.of_plane());
    if (!solids && free < kNoCollision)
        free = std::max(free, estimator.of_surfaces(0));
    return {false, true, free};
}

} // namespace abut
