#include "world/schedule/time_to_collision_schedule.h"

#include "core/parallel.h"
#include "core/progress.h"
#include "core/stop.h"
#include "world/broad_phase/box_node.h"
#include "world/schedule/prescribed_impact.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace abut {

namespace {

Vec3 place_of(const Body& body) {
    const auto& m = body.world_from_body.m;
    return {m[9], m[10], m[11]};
}

/// If fewer measurements than this share save their cost, a new pair first gets kFirstIdle tests for
/// contact.
constexpr double kWorthTrying = 0.3;
constexpr std::uint8_t kFirstIdle = 7;

/// The time `wait` after now, rounded down.
double time_after(double now, double wait) {
    return wait < kNoCollision ? (now + wait) * (1 - 0x1p-52) : kNoCollision;
}

} // namespace

CollisionSchedule::CollisionSchedule(const WorldData& world)
    : world_(world),
      broad_phase_({BroadPhaseMethod::automatic,
                    [this](std::uint32_t i, std::uint32_t k) { return world_.may_meet(i, k); }}) {}

bool CollisionSchedule::takes_part(std::uint32_t body) const {
    const Body& b = world_.bodies()[body];
    return b.alive && !is_empty(b.own_bounds);
}

void CollisionSchedule::set_speed(std::uint32_t body, const SpeedBounds& bounds) {
    const Body& of = world_.bodies()[body];
    if (is_deformable(of.shape))
        return; // it is at rest until it is refreshed, and then tested anew
    if (body >= courses_.size())
        courses_.resize(body + 1);
    Course& course = courses_[body];
    // If the new bounds follow from the old ones, the pairs' due times remain valid.
    const bool known = course.known && course.generation == of.generation &&
                       keeps_course(course, of, now_) && follows(course, bounds, now_);
    if (known && repeats(course, bounds))
        return;
    begin_course(course, of, now_);
    course.bounds = bounds, course.speed = 0;
    course.rests = is_at_rest(course_at(course, now_));
    course.known = known;
}

/// The bodies whose pairs' due times have become invalid: bodies with new bounds, off their course,
/// added or removed.
std::vector<std::uint32_t> CollisionSchedule::follow_courses() {
    const std::vector<Body>& bodies = world_.bodies();
    courses_.resize(bodies.size());
    swept_.resize(bodies.size());
    std::vector<std::uint32_t> strayed;
    for (std::uint32_t body = 0; body < courses_.size(); ++body) {
        Course& course = courses_[body];
        const Body& at = bodies[body];
        if (stays(course, at))
            continue;
        if (course.known && at.alive && course.generation == at.generation &&
            keeps_course(course, at, now_)) {
            if (!is_prescribed(course))
                note_place(course, at, now_);
            continue; // most bodies
        }
        const bool exists = takes_part(body), existed = abut::takes_part(swept_[body]);
        if (!exists && !existed)
            continue;
        if (exists) {
            const bool is_new = course.reach < 0 || course.generation != bodies[body].generation;
            if (is_new) {
                if (existed) // another body had this index, with other rules
                    broad_phase_.forget();
                course = {}; // its motion is not known
            }
            const bool keeps = !is_new && keeps_course(course, bodies[body], now_);
            if (existed && course.known && keeps)
                continue;
            if (keeps)
                note_place(course, bodies[body], now_);
            else
                begin_course(course, bodies[body], now_);
        }
        strayed.push_back(body);
    }
    return strayed;
}

double CollisionSchedule::chosen_horizon(double step) const {
    double size = 0, speed = 0, acceleration = 0;
    for (std::uint32_t body = 0; body < courses_.size(); ++body)
        if (takes_part(body)) {
            const CourseNow course = course_at(courses_[body], now_);
            const TurnBounds& turn = course.turn;
            if (!(turn.reach < kNoCollision))
                continue; // a half-space, which has no size
            size += turn.reach;
            speed += length(course.velocity) + course.speed +
                     turn.reach * (turn.speed + length(turn.velocity));
            acceleration += length(course.acceleration) + course.acceleration_bound;
        }
    // A body moves by about its own size until the horizon. Larger swept boxes cost little more,
    // and half the horizon would require two sweeps.
    const double sum = speed + std::sqrt(speed * speed + 4 * acceleration * size);
    return sum > 0 ? std::max(step, 4 * size / sum) : kNoCollision;
}

void CollisionSchedule::set_swept_box(std::uint32_t body) {
    const Body& of = world_.bodies()[body];
    swept_[body] = !takes_part(body) ? Box3{}
                                     : swept_box(course_at(courses_[body], now_), place_of(of),
                                                 world_.boxes()[body], horizon_ - now_);
}

void CollisionSchedule::sweep(const std::vector<std::uint32_t>& strayed, double step) {
    std::vector<std::uint32_t> changed = strayed;
    if (now_ >= horizon_) {
        horizon_ = now_ + chosen_horizon(step);
        changed.resize(courses_.size());
        std::iota(changed.begin(), changed.end(), 0);
    }
    for (const std::uint32_t body : changed)
        set_swept_box(body);
    broad_phase_.update(swept_, changed);
    follow_pairs(now_);
    if (strayed.empty())
        return;
    for (const std::uint32_t body : strayed)
        courses_[body].known = false;
    for (const IndexPair bodies : broad_phase_.pairs())
        if (const Course& a = courses_[bodies.a()], &b = courses_[bodies.b()];
            !a.known || !b.known) {
            const std::uint32_t place = place_of_.at(bodies.key());
            make_due(place, now_);
            if (a.reshaped || b.reshaped)
                memories_[place] = {};
        }
    for (const std::uint32_t body : strayed)
        courses_[body].known = true, courses_[body].reshaped = false;
    forget_outdated();
}

/// Follows changes of bodies, bounds and places since the last step.
void CollisionSchedule::catch_up(double step) {
    const std::vector<std::uint32_t> strayed = follow_courses();
    if (!strayed.empty() || now_ >= horizon_)
        sweep(strayed, step);
}

/// Gives places to the pairs that have begun, which are due at a time, and takes those of pairs that
/// ended.
void CollisionSchedule::follow_pairs(double begun_due) {
    for (const IndexPair bodies : broad_phase_.ended()) {
        const auto found = place_of_.find(bodies.key());
        pairs_[found->second] = {}, memories_[found->second] = {};
        free_pairs_.push_back(found->second);
        place_of_.erase(found);
    }
    for (const IndexPair bodies : broad_phase_.begun()) {
        if (free_pairs_.empty()) {
            free_pairs_.push_back(static_cast<std::uint32_t>(pairs_.size()));
            pairs_.emplace_back(), memories_.emplace_back();
        }
        const std::uint32_t place = free_pairs_.back();
        free_pairs_.pop_back();
        place_of_[bodies.key()] = place;
        pairs_[place].bodies = bodies, pairs_[place].alive = true;
        make_due(place, begun_due);
    }
}

void CollisionSchedule::make_due(std::uint32_t pair, double time) {
    pairs_[pair].due = time, pairs_[pair].improved = false;
    if (time < kNoCollision) {
        queue_.push_back({time, pair});
        std::push_heap(queue_.begin(), queue_.end());
    }
}

bool CollisionSchedule::is_outdated(const Due& due) const {
    return !pairs_[due.pair].alive || pairs_[due.pair].due != due.time;
}

void CollisionSchedule::take_first() {
    std::pop_heap(queue_.begin(), queue_.end());
    queue_.pop_back();
}

/// Removes outdated entries of the queue, if most are.
void CollisionSchedule::forget_outdated() {
    if (queue_.size() < 4 * place_of_.size() + 1000)
        return;
    std::erase_if(queue_, [&](const Due& due) { return is_outdated(due); });
    std::make_heap(queue_.begin(), queue_.end());
}

/// The pairs that are due or that touched at the last step, sorted by their bodies, each once.
std::vector<std::uint32_t> CollisionSchedule::take_due() {
    std::vector<std::pair<IndexPair, std::uint32_t>> due;
    for (const std::uint32_t pair : std::exchange(touching_, {}))
        if (pairs_[pair].alive)
            due.emplace_back(pairs_[pair].bodies, pair);
    const auto touching = static_cast<std::ptrdiff_t>(due.size()); // sorted, as a rule
    for (; !queue_.empty() && queue_.front().time <= now_; take_first())
        if (!is_outdated(queue_.front()))
            due.emplace_back(pairs_[queue_.front().pair].bodies, queue_.front().pair);
    if (!std::is_sorted(due.begin(), due.begin() + touching))
        std::sort(due.begin(), due.begin() + touching);
    std::sort(due.begin() + touching, due.end());
    std::inplace_merge(due.begin(), due.begin() + touching, due.end());
    std::vector<std::uint32_t> result;
    for (const auto& [bodies, pair] : due)
        if (result.empty() || result.back() != pair)
            result.push_back(pair);
    return result;
}

PairNow CollisionSchedule::pair_now(IndexPair pair) const {
    const std::uint32_t a = pair.a(), b = pair.b();
    return {world_.placed(a), world_.placed(b), world_.boxes()[a], world_.boxes()[b],
            relative_motion(course_at(courses_[a], now_), course_at(courses_[b], now_))};
}

std::vector<PairEstimate> CollisionSchedule::estimates_of(const std::vector<std::uint32_t>& pairs,
                                                          double step, const Progress& progress) {
    const StopScope stopping(progress);
    ProgressMeter meter(progress, "distances", pairs.size());
    std::vector<PairEstimate> estimates(pairs.size());
    const std::uint8_t first_idle = paying_ < kWorthTrying ? kFirstIdle : 0;
    parallel_for(pairs.size(), 32, [&](std::size_t i) {
        const std::uint32_t pair = pairs[i];
        estimates[i] = estimate(pair_now(pairs_[pair].bodies), memories_[pair], step, first_idle);
        meter.advance();
    });
    return estimates;
}

void CollisionSchedule::count_payment(Measurement measurement) {
    constexpr double kMemory = 0x1p-6; // the last 64 measurements or so count
    if (measurement != Measurement::none)
        paying_ += kMemory * ((measurement == Measurement::paid ? 1 : 0) - paying_);
}

std::vector<BodyPair> CollisionSchedule::advance(double time, const Progress& progress) {
    now_ += time;
    if (time > 0)
        step_ = time;
    catch_up(time);
    const std::vector<std::uint32_t> due = take_due();
    std::vector<PairEstimate> estimates;
    try {
        estimates = estimates_of(due, step_, progress);
    } catch (...) {
        // Nothing is known of these pairs: they are due at the next step.
        for (const std::uint32_t pair : due)
            make_due(pair, now_);
        throw;
    }
    std::vector<BodyPair> touching;
    for (std::size_t i = 0; i < due.size(); ++i) {
        Pair& pair = pairs_[due[i]];
        counters_.distance_queries += estimates[i].measured ? 1 : 0;
        count_payment(estimates[i].measurement);
        if (estimates[i].touch) {
            touching.push_back(world_.ids_of(pair.bodies));
            touching_.push_back(due[i]);
            pair.due = now_;
        } else {
            make_due(due[i], time_after(now_, estimates[i].free));
        }
    }
    ++counters_.steps;
    counters_.pairs += world_.size() * (world_.size() - 1) / 2;
    counters_.estimates += due.size();
    return touching;
}

void CollisionSchedule::extend_horizon(double horizon) {
    // Before the old horizon, only the pairs that are known already can meet.
    const double known_until = std::exchange(horizon_, horizon);
    for (std::uint32_t body = 0; body < courses_.size(); ++body)
        set_swept_box(body);
    broad_phase_.update(swept_);
    follow_pairs(known_until);
}

/// The time at which the first pair is due; infinite if there is none.
double CollisionSchedule::first_due() {
    while (!queue_.empty() && is_outdated(queue_.front()))
        take_first();
    return queue_.empty() ? kNoCollision : queue_.front().time;
}

/// The best estimate of a pair; with prescribed motions, it looks for the first contact itself, up to
/// the time `most` and to kFarther times what the bounds prove.
PairEstimate CollisionSchedule::best_of_pair(IndexPair bodies, PairMemory& memory, double most) {
    constexpr double kFarther = 1000;
    constexpr double kBeyond =
        1 + 0x1p-30; // so that rounding does not end the search before `most`
    const PairNow now = pair_now(bodies);
    PairEstimate best = best_estimate(now, memory);
    const Body &a = world_.bodies()[bodies.a()], &b = world_.bodies()[bodies.b()];
    if (now.motion.prescribed && !best.touch && best.free < most && !is_deformable(a.shape) &&
        !is_deformable(b.shape))
        best.free = std::max(
            best.free,
            prescribed_free_time(a, b, now.motion, std::min(kBeyond * most, kFarther * best.free)));
    return best;
}

/// Measures the pair that is due first, as well as it can be. Returns whether that may have changed
/// its time. In: there is a first pair.
bool CollisionSchedule::improve_first() {
    const std::uint32_t first = queue_.front().pair;
    Pair& pair = pairs_[first];
    if (pair.improved)
        return false;
    const PairEstimate best = best_of_pair(pair.bodies, memories_[first], horizon_ - now_);
    ++counters_.estimates;
    counters_.distance_queries += best.measured ? 1 : 0;
    const double due = pair.due;
    take_first();
    memories_[first].touched = best.touch;
    if (best.touch) // the next step tests it anyway; no entry of the queue has this time
        touching_.push_back(first), pair.due = kNoCollision;
    else
        make_due(first, std::max(due, time_after(now_, best.free)));
    // A search up to the horizon can go on once that has moved.
    pair.improved = best.touch || pair.due < horizon_;
    return true;
}

/// The time until the first event, at most the limit and the time until the horizon.
double CollisionSchedule::free_until_horizon(double limit) {
    const double end = std::min(horizon_, now_ + limit);
    while (first_due() < end && improve_first())
        poll_stop();
    return std::clamp(first_due() - now_, 0.0, std::min(horizon_ - now_, limit));
}

double CollisionSchedule::next_event() {
    catch_up(step_);
    return free_until_horizon(kNoCollision);
}

double CollisionSchedule::time_to_collision(double limit, const Progress& progress) {
    constexpr int kMostSweeps = 30;
    const StopScope stopping(progress);
    catch_up(step_);
    double free = free_until_horizon(limit);
    for (int i = 0; i < kMostSweeps && free < limit && now_ + free >= horizon_; ++i) {
        const double span = std::max(8 * (horizon_ - now_), step_);
        extend_horizon(std::min(now_ + span, now_ + limit));
        free = free_until_horizon(limit);
    }
    return free;
}

double CollisionSchedule::time_to_collision(std::uint32_t a, std::uint32_t b) {
    catch_up(step_);
    const IndexPair bodies(a, b);
    if (!takes_part(a) || !takes_part(b) || !world_.may_meet(bodies.a(), bodies.b()))
        return kNoCollision;
    PairMemory memory; // the answer does not depend on earlier ones
    return best_of_pair(bodies, memory, kNoCollision).free;
}

} // namespace abut
