#include <abut/world.h>

#include "core/arguments.h"
#include "core/parallel.h"
#include "deform/deformable_data.h"
#include "math/vector.h"
#include "world/narrow_phase/world_data.h"
#include "world/queries/body_errors.h"
#include "world/queries/find_pairs.h"
#include "world/queries/piece_results.h"
#include "world/schedule/body_impact.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

namespace abut {

namespace {

/// Returns whether a pose is where a body is, but for rounding.
bool is_same_place(const Body& body, const Pose& pose) {
    // A program that multiplies quaternions and adds positions loses some roundings in each step. This
    // allows for some thousand of them.
    constexpr double kSamePlace = 0x1p-40;
    const Transform& here = body.world_from_body;
    const Transform there = pose;
    const double size = length(body.own_bounds.upper - body.own_bounds.lower);
    const double far = std::max({std::abs(here.m[9]), std::abs(here.m[10]), std::abs(here.m[11]),
                                 std::isfinite(size) ? size : 0});
    for (std::size_t i = 0; i < here.m.size(); ++i)
        if (!(std::abs(here.m[i] - there.m[i]) <= kSamePlace * (i < 9 ? 1 : far)))
            return false;
    return true;
}

} // namespace

std::vector<BodyImpact> World::time_of_impact(const std::vector<BodyMotion>& motions,
                                              const ImpactOptions& options) {
    require_not_negative(options.absolute_error.value_or(0), "absolute error");
    const std::vector<Body>& bodies = data_->bodies();
    std::vector<Motion> motion_of(bodies.size());
    std::vector<std::uint8_t> named(bodies.size(), 0), moves(bodies.size(), 0);
    for (const BodyMotion& each : motions) {
        static_cast<void>(data_->body(each.body)); // throws if the id is not valid
        naming(each.body, [&] {
            require_rigid(bodies[each.body.index]);
            require(named[each.body.index] == 0, "moves twice in one step");
            static_cast<void>(at(each.motion, 1)); // throws if the motion is not valid
            require(is_same_place(bodies[each.body.index], each.motion.start),
                    "its motion does not start where the body is");
        });
        const bool stays = each.motion.velocity == Vec3{} && each.motion.angular_velocity == Vec3{};
        data_->for_each_piece(each.body.index, [&](std::uint32_t index) {
            motion_of[index] = each.motion;
            named[index] = 1, moves[index] = stays ? 0 : 1;
        });
    }
    data_->update_if_changed();
    std::vector<Box3> swept(bodies.size());
    parallel_for(bodies.size(), 64, [&](std::size_t i) {
        const Body& body = bodies[i];
        if (!body.alive)
            return;
        if (named[i] == 0)
            motion_of[i] = Motion::fixed(body.pose);
        if (const auto* surface = std::get_if<DeformableShape>(&body.shape))
            moves[i] = surface->surface->data().is_at_rest() ? 0 : 1;
        swept[i] = swept_bounds({body.shape, body.own_bounds, motion_of[i]});
    });
    const std::vector<IndexPair> pairs =
        overlapping_boxes(swept, 0, [&](std::uint32_t i, std::uint32_t k) {
            return (moves[i] != 0 || moves[k] != 0) && data_->may_meet(i, k);
        });
    ImpactOptions each = options;
    each.progress = {}; // find_each reports and polls for all pairs
    std::vector<std::vector<BodyImpact>> parts;
    std::vector<BodyImpact> impacts;
    find_each<BodyImpact>(
        options.progress, "impacts", pairs,
        [&](IndexPair pair, std::size_t /*k*/) -> std::optional<BodyImpact> {
            const Body &a = bodies[pair.a()], &b = bodies[pair.b()];
            const Impact impact = body_impact({a.shape, a.own_bounds, motion_of[pair.a()]},
                                              {b.shape, b.own_bounds, motion_of[pair.b()]}, each);
            if (!impact.meet)
                return std::nullopt;
            return BodyImpact{data_->id_of(pair.a()), data_->id_of(pair.b()), impact, a.piece,
                              b.piece};
        },
        parts, impacts);
    if (data_->has_pieces())
        unite_pieces(impacts);
    return impacts;
}

} // namespace abut
