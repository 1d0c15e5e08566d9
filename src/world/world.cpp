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
#include "world/queries/body_errors.h"
#include "world/queries/body_tree.h"
#include "world/queries/compound_data.h"
#include "world/queries/find_pairs.h"
#include "world/queries/piece_results.h"
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
    if (data.has_pieces())
        unite_pieces(result);
    return result;
}

/// Those of sorted pairs that are not among others.
template <typename Pair>
std::vector<Pair> without(const std::vector<Pair>& pairs, const std::vector<Pair>& others) {
    std::vector<Pair> result;
    std::set_difference(pairs.begin(), pairs.end(), others.begin(), others.end(),
                        std::back_inserter(result));
    return result;
}

/// The pairs of bodies at the update before the last one.
std::vector<BodyPair> earlier_pairs(const WorldData& data) {
    const BroadPhase& now = data.broad_phase();
    std::vector<IndexPair> pairs = without(now.pairs(), now.begun());
    pairs.insert(pairs.end(), now.ended().begin(), now.ended().end());
    return with_ids(data, pairs);
}

/// Sets the ids and pieces of a result of two bodies.
template <typename Result>
void name_bodies(const WorldData& data, IndexPair pair, Result& result) {
    result.a = data.id_of(pair.a()), result.b = data.id_of(pair.b());
    result.piece_a = data.bodies()[pair.a()].piece, result.piece_b = data.bodies()[pair.b()].piece;
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
BodyId World::add(const Compound& compound, const Pose& pose, const BodyOptions& options) {
    return naming(data_->next_id(), [&] {
        require_point(pose.translation, "position");
        return data_->add(compound.data().pieces, pose, options);
    });
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
const BodyOptions& World::options(BodyId body) const {
    return data_->body(body).options;
}
void World::set_user_data(BodyId body, std::uint64_t user_data) {
    data_->set_user_data(body, user_data);
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
std::size_t World::index_end() const noexcept {
    return data_->bodies().size();
}
const Transform& World::world_from_body(BodyId body) const {
    return data_->body(body).world_from_body;
}
Box3 World::box(BodyId body) const {
    static_cast<void>(data_->body(body)); // throws if the id is not valid
    Box3 all;
    data_->for_each_piece(body.index, [&](std::uint32_t index) {
        if (const Box3& box = data_->boxes()[index]; !is_empty(box))
            extend(all, box.lower), extend(all, box.upper);
    });
    return all;
}

void World::update() {
    data_->update();
}
std::vector<BodyPair> World::pairs() const {
    return with_ids(*data_, data_->broad_phase().pairs());
}
std::vector<BodyPair> World::begun() const {
    if (data_->has_pieces())
        return without(pairs(), earlier_pairs(*data_));
    return with_ids(*data_, data_->broad_phase().begun());
}
std::vector<BodyPair> World::ended() const {
    if (data_->has_pieces())
        return without(earlier_pairs(*data_), pairs());
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
    if (data_->has_pieces())
        unite_pieces(pairs);
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
            name_bodies(*data_, pair, gap);
            return gap;
        },
        data_->parts().gaps, gaps);
    if (data_->has_pieces())
        unite_pieces(gaps);
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
            name_bodies(*data_, pair, gap);
            return gap;
        },
        data_->parts().gaps, gaps);
    if (data_->has_pieces())
        unite_pieces(gaps);
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
    // A few more than in the last step: a list that is too short by one is copied.
    const std::size_t found = data_->parts().manifolds_found, expected = found + found / 16;
    auto* const touching = margin > 0 ? nullptr : &data_->warm_starts();
    find_all<ContactManifold>(
        progress, "contacts", margin > 0 ? near_pairs_->pairs() : data_->broad_phase().pairs(),
        [&](IndexPair pair, std::size_t k, std::vector<ContactManifold>& part) {
            const std::size_t first = part.size();
            append_contacts(
                {data_->placed(pair.a()), data_->placed(pair.b()), data_->placements_of(pair)},
                margin, touching != nullptr ? (*touching)[k] : near_pairs_->warm_start(k), part);
            for (std::size_t i = first; i < part.size(); ++i) {
                name_bodies(*data_, pair, part[i]);
                part[i].user_data_a = data_->bodies()[pair.a()].options.user_data;
                part[i].user_data_b = data_->bodies()[pair.b()].options.user_data;
            }
        },
        data_->parts().manifolds, manifolds, expected);
    data_->parts().manifolds_found = manifolds.size();
    if (data_->has_pieces())
        unite_pieces(manifolds);
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
    data_->for_each_piece(body.index,
                          [&](std::uint32_t index) { schedule_->set_speed(index, bounds); });
}

std::vector<BodyPair> World::advance(double time, const Progress& progress) {
    require(time >= 0 && time < HUGE_VAL, "time must not be negative, and finite");
    data_->update_if_changed();
    std::vector<BodyPair> touching = schedule_->advance(time, progress);
    if (data_->has_pieces())
        unite_pieces(touching);
    return touching;
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
    double first = HUGE_VAL;
    data_->for_each_piece(a.index, [&](std::uint32_t i) {
        data_->for_each_piece(b.index, [&](std::uint32_t k) {
            first = std::min(first, schedule_->time_to_collision(i, k));
        });
    });
    return first;
}
const ScheduleCounters& World::schedule_counters() const noexcept {
    return schedule_->counters();
}

} // namespace abut
