#include <abut/rigid_shape.h>
#include <abut/world.h>

#include "core/arguments.h"
#include "core/stop.h"
#include "math/vector.h"
#include "rigid/shapes/shape_arguments.h"
#include "world/narrow_phase/contact_rounding.h"
#include "world/narrow_phase/world_data.h"
#include "world/queries/body_tree.h"
#include "world/queries/ray_body.h"
#include "world/queries/rigid_shape_data.h"
#include "world/schedule/body_impact.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <variant>

namespace abut {

namespace {

bool is_asked(const WorldData& data, std::uint32_t index, const BodyQuery& query) {
    const Body& body = data.bodies()[index];
    return body.alive && (body.options.groups & query.groups) != 0 &&
           (!query.filter || query.filter(data.id_of(index)));
}

/// Returns whether a hit comes before another one: earlier, or as early and of a body or piece of lower number.
bool comes_first(const BodyRayHit& hit, const BodyRayHit& other) {
    return std::tie(hit.t, hit.body, hit.piece) < std::tie(other.t, other.body, other.piece);
}

bool comes_first(const BodySweepHit& hit, const BodySweepHit& other) {
    return std::tie(hit.impact.time, hit.body, hit.piece) <
           std::tie(other.impact.time, other.body, other.piece);
}

/// Removes all hits of a body but the first.
void keep_first_of_body(std::vector<BodyRayHit>& hits) {
    std::vector<bool> is_hit;
    std::erase_if(hits, [&](const BodyRayHit& hit) {
        if (hit.body.index >= is_hit.size())
            is_hit.resize(hit.body.index + 1);
        const bool again = is_hit[hit.body.index];
        is_hit[hit.body.index] = true;
        return again;
    });
}

} // namespace

const BodyTree& World::tree() {
    data_->update_if_changed();
    if (!tree_ || tree_->version() != data_->last_placement())
        tree_ = std::make_unique<BodyTree>(data_->boxes(), data_->last_placement());
    return *tree_;
}

BodyRayHit World::first_hit(const Ray& ray, const BodyQuery& query) {
    require_ray(ray);
    const StopScope stopping(query.progress);
    BodyRayHit first;
    tree().for_each_on_ray(ray, [&](std::uint32_t index) {
        poll_stop();
        if (is_asked(*data_, index, query)) {
            Ray rest = ray;
            rest.t_max = std::min(ray.t_max, first.t);
            BodyRayHit hit = ray_body_hit(data_->placed(index), rest, {});
            hit.body = data_->id_of(index), hit.piece = data_->bodies()[index].piece;
            if (hit.meet && (!first.meet || comes_first(hit, first)))
                first = hit;
        }
        return first.t;
    });
    return first;
}

std::vector<BodyRayHit> World::all_hits(const Ray& ray, const BodyQuery& query) {
    require_ray(ray);
    const StopScope stopping(query.progress);
    std::vector<BodyRayHit> hits;
    tree().for_each_on_ray(ray, [&](std::uint32_t index) {
        poll_stop();
        if (is_asked(*data_, index, query)) {
            BodyRayHit hit = ray_body_hit(data_->placed(index), ray, {});
            hit.body = data_->id_of(index), hit.piece = data_->bodies()[index].piece;
            if (hit.meet)
                hits.push_back(hit);
        }
        return ray.t_max;
    });
    std::sort(hits.begin(), hits.end(),
              [](const BodyRayHit& p, const BodyRayHit& q) { return comes_first(p, q); });
    if (data_->has_pieces())
        keep_first_of_body(hits);
    return hits;
}

std::vector<BodyId> World::overlaps(const RigidShape& shape, const Pose& pose,
                                    const BodyQuery& query) {
    require_point(pose.translation, "position");
    const StopScope stopping(query.progress);
    const RigidShapeData& asked = shape.data();
    const Transform world_from_shape = pose;
    std::vector<BodyId> found;
    // As large as the box of a body, so that what touches by rounding is found.
    const Box3 box = grown(bounds_of(asked.shape, asked.own_bounds, world_from_shape),
                           contact_share(asked.shape, asked.own_bounds));
    tree().for_each_overlap(box, [&](std::uint32_t index) {
        poll_stop();
        PairWarmStart warm_start;
        if (is_asked(*data_, index, query) &&
            touch(data_->placed(index), {asked.shape, world_from_shape}, warm_start))
            found.push_back(data_->id_of(index));
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

BodySweepHit World::sweep(const RigidShape& shape, const Motion& motion, const BodyQuery& query,
                          const ImpactOptions& options) {
    require_not_negative(options.absolute_error.value_or(0), "absolute error");
    static_cast<void>(at(motion, 1)); // throws if the motion is not valid
    const StopScope stopping(query.progress);
    const RigidShapeData& asked = shape.data();
    const MovingBody moving{asked.shape, asked.own_bounds, motion};
    std::vector<std::uint32_t> candidates;
    tree().for_each_overlap(swept_bounds(moving), [&](std::uint32_t index) {
        if (is_asked(*data_, index, query))
            candidates.push_back(index);
    });
    std::sort(candidates.begin(), candidates.end());
    BodySweepHit first;
    for (const std::uint32_t index : candidates) {
        poll_stop();
        const Body& body = data_->bodies()[index];
        const Motion stays = Motion::fixed(body.pose);
        // A deformable would move by its own step.
        const auto* deformable = std::get_if<DeformableShape>(&body.shape);
        std::optional<BodyShape> still;
        if (deformable != nullptr)
            still.emplace(deformable->snapshot->model());
        const Impact impact =
            body_impact({still ? *still : body.shape, body.own_bounds, stays}, moving, options);
        const BodySweepHit hit{impact.meet, data_->id_of(index), impact, body.piece};
        if (hit.meet && (!first.meet || comes_first(hit, first)))
            first = hit;
    }
    return first;
}

} // namespace abut
