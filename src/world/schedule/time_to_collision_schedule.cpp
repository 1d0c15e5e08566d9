#include "world/schedule/time_to_collision_schedule.h"

#include "core/parallel.h"
#include "core/progress.h"
#include "math/transform.h"
#include "rigid/shapes/shape_arguments.h"
#include "world/broad_phase/box_node.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace abut {

namespace {

/// kOffCourse bounds how far the caller's rounding may move a body off its course, relative to the
/// coordinates. kGapRounding is subtracted from lengths and times to cover that and this file's
/// rounding.
constexpr double kOffCourse = 0x1p-48;
constexpr double kGapRounding = 0x1p-40;
constexpr double kNever = std::numeric_limits<double>::infinity();

Vec3 moved_by(const SpeedBounds& bounds, double t) {
    return t * bounds.velocity + (0.5 * t * t) * bounds.acceleration;
}

} // namespace

CollisionSchedule::CollisionSchedule(const WorldData& world)
    : world_(world),
      broad_phase_({BroadPhaseMethod::automatic,
                    [this](std::uint32_t i, std::uint32_t k) { return world_.may_meet(i, k); }}) {}

Vec3 CollisionSchedule::origin_of(std::uint32_t body) const {
    const auto& m = world_.bodies()[body].world_from_body.m;
    return {m[9], m[10], m[11]};
}

bool CollisionSchedule::takes_part(std::uint32_t body) const {
    const Body& b = world_.bodies()[body];
    return b.alive && !is_deformable(b.shape) && !is_empty(b.own_bounds);
}

double CollisionSchedule::reach_of(std::uint32_t body) const {
    return reach_from(world_.bodies()[body].shape, world_.bodies()[body].own_bounds, {});
}

void CollisionSchedule::set_speed(std::uint32_t body, const SpeedBounds& bounds) {
    if (body >= courses_.size())
        courses_.resize(body + 1);
    Course& course = courses_[body];
    const SpeedBounds& old = course.bounds;
    const double t = now_ - course.since;
    const Vec3 off = bounds.velocity - old.velocity - t * old.acceleration;
    // If the new bounds follow from the old ones, the pairs' due times remain valid.
    course.known = course.known && course.generation == world_.bodies()[body].generation &&
                   keeps_course(body) && bounds.acceleration == old.acceleration &&
                   bounds.acceleration_bound <= old.acceleration_bound &&
                   bounds.angular_speed <= old.angular_speed &&
                   length(off) <= old.acceleration_bound * t + kOffCourse * length(bounds.velocity);
    course.since = now_, course.origin = origin_of(body), course.bounds = bounds;
    course.generation = world_.bodies()[body].generation;
}

bool CollisionSchedule::keeps_course(std::uint32_t body) const {
    const Course& course = courses_[body];
    const double t = now_ - course.since;
    const Vec3 expected = course.origin + moved_by(course.bounds, t), is = origin_of(body);
    return length(is - expected) <= 0.5 * course.bounds.acceleration_bound * t * t +
                                        kOffCourse * (max_abs(is) + max_abs(expected));
}

/// The bodies whose pairs' due times have become invalid: bodies with new bounds, off their course,
/// added or removed.
std::vector<std::uint32_t> CollisionSchedule::follow_courses() {
    courses_.resize(world_.bodies().size());
    swept_.resize(world_.bodies().size());
    std::vector<std::uint32_t> strayed;
    for (std::uint32_t body = 0; body < courses_.size(); ++body) {
        Course& course = courses_[body];
        const bool exists = takes_part(body), existed = abut::takes_part(swept_[body]);
        if (!exists && !existed)
            continue;
        const std::uint32_t generation = world_.bodies()[body].generation;
        if (course.generation != generation) // a new body, whose motion is not known
            course = {now_, origin_of(body), {}, generation, false};
        if (exists && existed && course.known && keeps_course(body))
            continue;
        if (exists && !keeps_course(body))
            course.since = now_, course.origin = origin_of(body);
        strayed.push_back(body);
    }
    return strayed;
}

double CollisionSchedule::chosen_horizon(double step) const {
    double size = 0, speed = 0;
    for (std::uint32_t body = 0; body < courses_.size(); ++body)
        if (takes_part(body)) {
            const SpeedBounds& bounds = courses_[body].bounds;
            size += reach_of(body);
            speed += length(bounds.velocity) + reach_of(body) * bounds.angular_speed;
        }
    // A body moves by about its own size until the horizon. Larger swept boxes cost little more,
    // and half the horizon would require two sweeps.
    return std::max(step, speed > 0 ? 2 * size / speed : 16 * step);
}

Box3 CollisionSchedule::swept_box(std::uint32_t body) const {
    if (!takes_part(body))
        return {};
    const Course& course = courses_[body];
    const SpeedBounds& bounds = course.bounds;
    const double begin = now_ - course.since, end = horizon_ - course.since;
    const Vec3 here = moved_by(bounds, begin);
    const double most = length(bounds.velocity) + length(bounds.acceleration) * end;
    // The path is a parabola. Between its ends, it deviates from the chord by at most the sagitta.
    const double span = end - begin, sagitta = length(bounds.acceleration) * span * span / 8;
    const double by = 0.5 * bounds.acceleration_bound * end * end + sagitta +
                      std::min(bounds.angular_speed * span, 2.0) * reach_of(body) +
                      kGapRounding * (most * end + max_abs(origin_of(body)));
    const Vec3 way = moved_by(bounds, end) - here, margin{by, by, by};
    const Box3& box = world_.boxes()[body];
    return {min(box.lower, box.lower + way) - margin, max(box.upper, box.upper + way) + margin};
}

void CollisionSchedule::sweep(const std::vector<std::uint32_t>& strayed, double step) {
    std::vector<std::uint32_t> changed = strayed;
    if (now_ >= horizon_) {
        horizon_ = now_ + chosen_horizon(step);
        changed.resize(courses_.size());
        std::iota(changed.begin(), changed.end(), 0);
    }
    for (const std::uint32_t body : changed)
        swept_[body] = swept_box(body);
    broad_phase_.update(swept_, changed);
    carry_over(due_, broad_phase_, -kNever);
    for (const std::uint32_t body : strayed)
        courses_[body].known = false;
    const std::vector<IndexPair>& pairs = broad_phase_.pairs();
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (due_[k] == -kNever || !courses_[pairs[k].a()].known || !courses_[pairs[k].b()].known)
            make_due(k, now_);
    for (const std::uint32_t body : strayed)
        courses_[body].known = true;
}

void CollisionSchedule::make_due(std::size_t pair, double time) {
    due_[pair] = time;
    queue_.push({time, broad_phase_.pairs()[pair]});
}

/// The pairs that are due or that touched at the last step, sorted, each once.
std::vector<IndexPair> CollisionSchedule::take_due() {
    std::vector<IndexPair> due = std::exchange(touching_, {});
    while (!queue_.empty() && queue_.top().time <= now_) {
        due.push_back(queue_.top().pair);
        queue_.pop();
    }
    std::sort(due.begin(), due.end());
    due.erase(std::unique(due.begin(), due.end()), due.end());
    return due;
}

// The solution of d = v t + a t^2 / 2, which is t = (sqrt(v^2 + 2 a d) - v) / a, without
// cancellation.
double CollisionSchedule::time_to_collision(IndexPair pair, double distance) const {
    const Course &a = courses_[pair.a()], &b = courses_[pair.b()];
    const double since_a = now_ - a.since, since_b = now_ - b.since;
    const Vec3 velocity_a = a.bounds.velocity + since_a * a.bounds.acceleration,
               velocity_b = b.bounds.velocity + since_b * b.bounds.acceleration;
    const double v = length(velocity_a - velocity_b) + a.bounds.acceleration_bound * since_a +
                     b.bounds.acceleration_bound * since_b +
                     reach_of(pair.a()) * a.bounds.angular_speed +
                     reach_of(pair.b()) * b.bounds.angular_speed;
    const double acceleration = length(a.bounds.acceleration - b.bounds.acceleration) +
                                a.bounds.acceleration_bound + b.bounds.acceleration_bound;
    const double size = max_abs(origin_of(pair.a())) + max_abs(origin_of(pair.b())) + distance;
    const double d = distance - kGapRounding * size;
    if (d <= 0)
        return 0;
    const double sum = v + std::sqrt(v * v + 2 * acceleration * d);
    return sum > 0 ? 2 * d / sum * (1 - kGapRounding) : kNever;
}

/// 0 for pairs that share a point.
std::vector<double> CollisionSchedule::distances_of(const std::vector<std::size_t>& pairs,
                                                    const Progress& progress) const {
    const StopScope stopping(progress);
    ProgressMeter meter(progress, "distances", pairs.size());
    std::vector<double> distances(pairs.size());
    parallel_for(pairs.size(), 8, [&](std::size_t i) {
        const IndexPair pair = broad_phase_.pairs()[pairs[i]];
        const PlacedBody a = world_.placed(pair.a()), b = world_.placed(pair.b());
        PairWarmStart warm_start;
        distances[i] =
            touch(a, b, warm_start)
                ? 0
                : std::max(gap_between(a, b, kNever, Depths::no, warm_start).distance, 0.0);
        meter.advance();
    });
    return distances;
}

std::vector<BodyPair> CollisionSchedule::advance(double time, const Progress& progress) {
    require(time >= 0 && time < kNever, "time must not be negative, and finite");
    now_ += time;
    const std::vector<std::uint32_t> strayed = follow_courses();
    if (!strayed.empty() || now_ >= horizon_)
        sweep(strayed, time);
    const std::vector<IndexPair>& pairs = broad_phase_.pairs();
    std::vector<std::size_t> looked_at;
    for (const IndexPair pair : take_due()) {
        const auto k = static_cast<std::size_t>(std::lower_bound(pairs.begin(), pairs.end(), pair) -
                                                pairs.begin());
        if (k < pairs.size() && pairs[k] == pair && due_[k] <= now_)
            looked_at.push_back(k);
    }
    std::vector<double> distances;
    try {
        distances = distances_of(looked_at, progress);
    } catch (...) {
        // Nothing is known of these pairs: they are due at the next step.
        for (const std::size_t k : looked_at)
            make_due(k, due_[k]);
        throw;
    }
    std::vector<BodyPair> touching;
    for (std::size_t i = 0; i < looked_at.size(); ++i) {
        const IndexPair pair = pairs[looked_at[i]];
        if (distances[i] > 0) {
            make_due(looked_at[i], now_ + time_to_collision(pair, distances[i]));
            continue;
        }
        touching.push_back(world_.ids_of(pair));
        touching_.push_back(pair);
        due_[looked_at[i]] = now_;
    }
    ++counters_.steps;
    counters_.pairs += world_.size() * (world_.size() - 1) / 2;
    counters_.distance_queries += looked_at.size();
    return touching;
}

double CollisionSchedule::next_event() const {
    double first = horizon_;
    if (!queue_.empty())
        first = std::min(first, queue_.top().time);
    return std::max(first - now_, 0.0);
}

} // namespace abut
