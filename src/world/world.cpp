#include <abut/error.h>
#include <abut/world.h>

#include "core/arguments.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "deform/deformable_data.h"
#include "rigid/shapes/shape_arguments.h"
#include "world/contacts/body_contacts.h"
#include "world/contacts/near_pairs.h"
#include "world/narrow_phase/world_data.h"
#include "world/queries/body_tree.h"
#include "world/schedule/body_impact.h"
#include "world/schedule/time_to_collision_schedule.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace abut {

namespace {

/// Calls work() and prefixes the message of an error with the body's index.
template <typename Work>
auto naming(BodyId id, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code(), "body " + std::to_string(id.index) + ": " + error.what());
    }
}

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

void require_rigid(const Body& body) {
    require(!is_deformable(body.shape), "is deformable: it moves as its own step says");
}

template <typename Shape>
BodyId add_to(WorldData& data, const Shape& make_shape, const Pose& pose,
              const BodyOptions& options) {
    return naming(data.next_id(), [&] {
        require_point(pose.translation, "position");
        return data.add(make_shape(), pose, options);
    });
}

std::vector<BodyPair> with_ids(const WorldData& data, const std::vector<IndexPair>& pairs) {
    std::vector<BodyPair> result;
    result.reserve(pairs.size());
    for (const IndexPair pair : pairs)
        result.push_back(data.ids_of(pair));
    return result;
}

/// Calls append(pair, k, results) for the k-th pair, in parallel. Sets the results to all of them, in order.
///
/// In          parts: memory that is used again. expected: number of results, about.
template <typename Result, typename Append>
void find_all(const Progress& progress, std::string_view stage, const std::vector<IndexPair>& pairs,
              const Append& append, std::vector<std::vector<Result>>& parts,
              std::vector<Result>& results, std::size_t expected = 0) {
    constexpr std::size_t kPairsOfTask = 16;
    const StopScope stopping(progress);
    ProgressMeter meter(progress, stage, pairs.size());
    results.clear();
    results.reserve(expected);
    const auto append_task = [&](std::size_t task, std::vector<Result>& part) {
        const std::size_t end = std::min(pairs.size(), (task + 1) * kPairsOfTask);
        for (std::size_t k = task * kPairsOfTask; k < end; ++k)
            append(pairs[k], k, part);
        meter.advance(end - task * kPairsOfTask);
    };
    const std::size_t tasks = (pairs.size() + kPairsOfTask - 1) / kPairsOfTask;
    if (is_sequential()) {
        for (std::size_t task = 0; task < tasks; ++task) {
            poll_stop();
            append_task(task, results);
        }
        return;
    }
    if (parts.size() < tasks)
        parts.resize(tasks);
    parallel_for(tasks, 1, [&](std::size_t task) {
        parts[task].clear();
        append_task(task, parts[task]);
    });
    for (std::size_t task = 0; task < tasks; ++task)
        results.insert(results.end(), parts[task].begin(), parts[task].end());
}

/// As find_all, where find(pair, k) returns a result or none.
template <typename Result, typename Find>
void find_each(const Progress& progress, std::string_view stage,
               const std::vector<IndexPair>& pairs, const Find& find,
               std::vector<std::vector<Result>>& parts, std::vector<Result>& results) {
    find_all<Result>(
        progress, stage, pairs,
        [&](IndexPair pair, std::size_t k, std::vector<Result>& part) {
            if (std::optional<Result> result = find(pair, k))
                part.push_back(*result);
        },
        parts, results);
}

} // namespace

World::World(WorldOptions options)
    : data_(std::make_unique<WorldData>(std::move(options))),
      schedule_(std::make_unique<CollisionSchedule>(*data_)),
      near_pairs_(std::make_unique<NearPairs>(*data_)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

BodyId World::add(const Model& model, const Pose& pose, const BodyOptions& options) {
    return add_to(
        *data_, [&] { return BodyShape(model); }, pose, options);
}
BodyId World::add(const Convex& convex, const Pose& pose, const BodyOptions& options) {
    return add_to(
        *data_, [&] { return shape_of(convex); }, pose, options);
}
BodyId World::add(const Sphere& sphere, const Pose& pose, const BodyOptions& options) {
    return add_to(
        *data_, [&] { return shape_of(sphere); }, pose, options);
}
BodyId World::add(const Capsule& capsule, const Pose& pose, const BodyOptions& options) {
    return add_to(
        *data_, [&] { return shape_of(capsule); }, pose, options);
}
BodyId World::add(const Box3& box, const Pose& pose, const BodyOptions& options) {
    return add_to(
        *data_, [&] { return shape_of(box); }, pose, options);
}
BodyId World::add(const Cylinder& cylinder, const Pose& pose, const BodyOptions& options) {
    return add_to(
        *data_, [&] { return shape_of(cylinder); }, pose, options);
}
BodyId World::add(const Cone& cone, const Pose& pose, const BodyOptions& options) {
    return add_to(
        *data_, [&] { return shape_of(cone); }, pose, options);
}
BodyId World::add(const Ellipsoid& ellipsoid, const Pose& pose, const BodyOptions& options) {
    return add_to(
        *data_, [&] { return shape_of(ellipsoid); }, pose, options);
}
BodyId World::add(const HalfSpace& half_space, const Pose& pose, const BodyOptions& options) {
    return add_to(
        *data_, [&] { return shape_of(half_space); }, pose, options);
}
BodyId World::add(const Deformable& surface, const BodyOptions& options) {
    return data_->add(shape_of(shared(surface)), {}, options);
}

void World::move(BodyId body, const Pose& pose) {
    const Body& moved = data_->body(body); // outside `naming`: its message names the body
    naming(body, [&] {
        require_rigid(moved);
        require_point(pose.translation, "position");
        data_->move(body, pose);
    });
}
void World::refresh(BodyId body) {
    data_->refresh(body);
}
void World::remove(BodyId body) {
    data_->remove(body);
}
void World::set_options(BodyId body, const BodyOptions& options) {
    data_->set_options(body, options);
    schedule_->forget();
    near_pairs_->forget();
}
void World::refilter() {
    data_->refilter();
    schedule_->forget();
    near_pairs_->forget();
}

bool World::is_valid(BodyId body) const noexcept {
    return data_->is_valid(body);
}
std::size_t World::size() const noexcept {
    return data_->size();
}
const Transform& World::world_from_body(BodyId body) const {
    return data_->body(body).world_from_body;
}
Box3 World::box(BodyId body) const {
    static_cast<void>(data_->body(body)); // throws if the id is not valid
    return data_->boxes()[body.index];
}

void World::update() {
    data_->update();
}
std::vector<BodyPair> World::pairs() const {
    return with_ids(*data_, data_->broad_phase().pairs());
}
std::vector<BodyPair> World::begun() const {
    return with_ids(*data_, data_->broad_phase().begun());
}
std::vector<BodyPair> World::ended() const {
    return with_ids(*data_, data_->broad_phase().ended());
}

std::vector<BodyPair> World::collide(const Progress& progress) {
    std::vector<BodyPair> pairs;
    collide(pairs, progress);
    return pairs;
}

void World::collide(std::vector<BodyPair>& pairs, const Progress& progress) {
    data_->update_if_changed();
    std::vector<PairWarmStart>& warm_starts = data_->warm_starts();
    find_each<BodyPair>(
        progress, "touching", data_->broad_phase().pairs(),
        [&](IndexPair pair, std::size_t k) -> std::optional<BodyPair> {
            if (!touch(data_->placed(pair.a()), data_->placed(pair.b()), warm_starts[k]))
                return std::nullopt;
            return data_->ids_of(pair);
        },
        data_->parts().pairs, pairs);
}

std::vector<BodyGap> World::penetration(const Progress& progress) {
    std::vector<BodyGap> gaps;
    penetration(gaps, progress);
    return gaps;
}

void World::penetration(std::vector<BodyGap>& gaps, const Progress& progress) {
    data_->update_if_changed();
    std::vector<PairWarmStart>& warm_starts = data_->warm_starts();
    find_each<BodyGap>(
        progress, "contacts", data_->broad_phase().pairs(),
        [&](IndexPair pair, std::size_t k) -> std::optional<BodyGap> {
            const PlacedBody a = data_->placed(pair.a()), b = data_->placed(pair.b());
            PairWarmStart& warm_start = warm_starts[k];
            // For two convex bodies, the gap alone tells whether they touch.
            const bool both_convex = is_convex(a.shape) && is_convex(b.shape);
            if (!both_convex && !touch(a, b, warm_start))
                return std::nullopt;
            BodyGap gap = gap_between(a, b, both_convex ? 0 : HUGE_VAL, Depths::yes, warm_start);
            if (both_convex && gap.distance > 0)
                return std::nullopt;
            std::tie(gap.a, gap.b) = std::pair(data_->id_of(pair.a()), data_->id_of(pair.b()));
            return gap;
        },
        data_->parts().gaps, gaps);
}

std::vector<BodyGap> World::within(double distance, const Progress& progress) {
    require(distance >= 0 && distance < HUGE_VAL, "distance must be a length, not negative");
    data_->update_if_changed();
    const std::vector<IndexPair> near =
        overlapping_boxes(data_->boxes(), distance,
                          [&](std::uint32_t i, std::uint32_t k) { return data_->may_meet(i, k); });
    std::vector<BodyGap> gaps;
    find_each<BodyGap>(
        progress, "distances", near,
        [&](IndexPair pair, std::size_t /*k*/) -> std::optional<BodyGap> {
            PairWarmStart warm_start;
            // If the true distance exceeds the bound, the result may be the bound itself. The bound
            // is therefore just above `distance`.
            BodyGap gap = signed_gap_between(data_->placed(pair.a()), data_->placed(pair.b()),
                                             std::nextafter(distance, HUGE_VAL), warm_start);
            if (gap.distance > distance)
                return std::nullopt;
            std::tie(gap.a, gap.b) = std::pair(data_->id_of(pair.a()), data_->id_of(pair.b()));
            return gap;
        },
        data_->parts().gaps, gaps);
    return gaps;
}

std::vector<ContactManifold> World::contact_manifolds(double margin, const Progress& progress) {
    std::vector<ContactManifold> manifolds;
    contact_manifolds(manifolds, margin, progress);
    return manifolds;
}

void World::contact_manifolds(std::vector<ContactManifold>& manifolds, double margin,
                              const Progress& progress) {
    require(margin >= 0 && margin < HUGE_VAL, "margin must be a length, not negative");
    data_->update_if_changed();
    if (margin > 0)
        near_pairs_->update(margin);
    auto& warm_starts = margin > 0 ? near_pairs_->warm_starts() : data_->warm_starts();
    find_all<ContactManifold>(
        progress, "contacts", margin > 0 ? near_pairs_->pairs() : data_->broad_phase().pairs(),
        [&](IndexPair pair, std::size_t k, std::vector<ContactManifold>& part) {
            append_contacts({data_->placed(pair.a()), data_->placed(pair.b()), data_->ids_of(pair),
                             data_->placements_of(pair)},
                            margin, warm_starts[k], part);
        },
        data_->parts().manifolds, manifolds, data_->parts().manifolds_found);
    data_->parts().manifolds_found = manifolds.size();
}

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
        motion_of[each.body.index] = each.motion;
        named[each.body.index] = 1;
        moves[each.body.index] =
            each.motion.velocity == Vec3{} && each.motion.angular_velocity == Vec3{} ? 0 : 1;
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
            return BodyImpact{data_->id_of(pair.a()), data_->id_of(pair.b()), impact};
        },
        parts, impacts);
    return impacts;
}

void World::set_speed(BodyId body, const SpeedBounds& bounds) {
    static_cast<void>(data_->body(body)); // throws if the id is not valid
    naming(body, [&] {
        require(is_finite(bounds.velocity) && is_finite(bounds.acceleration) &&
                    is_finite(bounds.angular_velocity),
                "velocity or acceleration is not finite");
        for (const double bound :
             {bounds.acceleration_bound, bounds.angular_speed, bounds.angular_acceleration})
            require(bound >= 0 && bound < HUGE_VAL,
                    "bounds of a speed must not be negative, and finite");
    });
    schedule_->set_speed(body.index, bounds);
}

std::vector<BodyPair> World::advance(double time, const Progress& progress) {
    require(time >= 0 && time < HUGE_VAL, "time must not be negative, and finite");
    data_->update_if_changed();
    return schedule_->advance(time, progress);
}
double World::next_event() {
    data_->update_if_changed();
    return schedule_->next_event();
}
double World::time_to_collision(double limit, const Progress& progress) {
    require_not_negative(limit, "limit of a time to collision");
    data_->update_if_changed();
    return schedule_->time_to_collision(limit, progress);
}
double World::time_to_collision(BodyId a, BodyId b) {
    static_cast<void>(data_->body(a)), static_cast<void>(data_->body(b)); // throw if not valid
    require(a.index != b.index, "a time to collision needs two bodies");
    data_->update_if_changed();
    return schedule_->time_to_collision(a.index, b.index);
}
const ScheduleCounters& World::schedule_counters() const noexcept {
    return schedule_->counters();
}

} // namespace abut
