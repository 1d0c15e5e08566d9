#include <abut/walker.h>

#include "rigid/shapes/shape_arguments.h"
#include "view/walker/clip_planes.h"
#include "view/walker/walker_data.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// A step is divided into parts of at most this long, and into at most this many.
constexpr double kLongestPart = 0.025, kMostParts = 64;
constexpr double kFastestFall = 100; ///< length / second

} // namespace

WalkerData::WalkerData(Walk& walk, const Vec3& feet, const WalkerOptions& options)
    : person_(walk, options), mode_(options.mode) {
    move_to(feet);
}

Capsule WalkerData::capsule() const {
    Capsule capsule = person_.capsule(state_.ducked);
    capsule.axis.a = capsule.axis.a + state_.feet, capsule.axis.b = capsule.axis.b + state_.feet;
    return capsule;
}

void WalkerData::move_to(const Vec3& feet) {
    require_point(feet, "place of the walker");
    const bool ducked = state_.ducked;
    state_ = {};
    state_.feet = feet, state_.ducked = ducked;
    const double eye = ducked ? person_.options().ducked_eye_height : person_.options().eye_height;
    state_.eye = feet + eye * person_.up();
    rising_ = 0;
    must_settle_ = true;
}

void WalkerData::set_mode(WalkerMode mode) {
    mode_ = mode;
    state_.on_ground = false;
    rising_ = 0;
}

void WalkerData::step(const Vec3& wish, double seconds, bool duck, bool jump) {
    require_point(wish, "velocity of the walker");
    require(seconds >= 0 && seconds <= 1e6, "time of the walker's step must not be negative");
    const Vec3 before = state_.feet;
    state_.blocked = state_.waits = false;
    state_.way = {before};
    set_duck(duck);
    if (must_settle_)
        settle();
    if (jump && state_.on_ground && mode_ == WalkerMode::walk && !state_.squeezed) {
        rising_ = person_.options().jump_speed;
        state_.on_ground = false;
    }
    const bool falls = mode_ == WalkerMode::walk && !state_.on_ground && !state_.squeezed &&
                       (rising_ > 0 || is_ground_below());
    const double parts = std::clamp(std::ceil(seconds / kLongestPart), 1.0, kMostParts);
    const double part = seconds / parts;
    for (int i = 0; i < static_cast<int>(parts) && seconds > 0; ++i) {
        if (state_.squeezed)
            fly(person_.thin_bodies()[thin_], part * wish);
        else if (mode_ == WalkerMode::fly)
            fly(body(), part * wish);
        else if (state_.on_ground)
            walk(part * person_.horizontal(wish));
        else
            fall(part * person_.horizontal(wish), falls ? part : 0);
    }
    const double eye =
        state_.ducked ? person_.options().ducked_eye_height : person_.options().eye_height;
    state_.eye = state_.feet + eye * person_.up();
    state_.velocity = seconds > 0 ? (1 / seconds) * (state_.feet - before) : Vec3{};
    person_.walk().move_to(state_.eye, state_.velocity);
}

void WalkerData::arrive(const Vec3& feet) {
    if (feet == state_.feet)
        return;
    state_.feet = feet;
    state_.way.push_back(feet);
}

Advance WalkerData::advance(const Vec3& way) {
    Vec3 feet = state_.feet;
    Advance result = person_.advance(body(), feet, way);
    arrive(feet);
    state_.waits = state_.waits || result.waits;
    must_settle_ = must_settle_ || result.overlaps;
    return result;
}

void WalkerData::set_duck(bool duck) {
    if (duck == state_.ducked)
        return;
    if (!duck && !state_.squeezed) { // stands up only where there is room
        Vec3 feet = state_.feet;
        const WalkerOptions& o = person_.options();
        const double rise = o.height - o.ducked_height + 0.5 * o.skin;
        if (!person_.advance(person_.body(true), feet, rise * person_.up()).is_free())
            return;
    }
    state_.ducked = duck;
}

bool WalkerData::is_ground_below() {
    constexpr double kDeep = 1e4;
    const FirstContact contact =
        person_.walk().sweep(body(), Pose{state_.feet}, -kDeep * person_.up(), person_.query());
    return contact.meet || !contact.complete;
}

void WalkerData::fly(const Probe& body, Vec3 way) {
    ClipPlanes planes;
    while (length(way) > 0) {
        Vec3 feet = state_.feet;
        const Advance step = person_.advance(body, feet, way);
        arrive(feet);
        state_.waits = state_.waits || step.waits;
        if (!step.hit)
            return;
        state_.blocked = true;
        must_settle_ = must_settle_ || (step.overlaps && !state_.squeezed);
        if (step.overlaps || planes.full())
            return;
        planes.add(step.impact.normal);
        way = planes.clipped((1 - step.share) * way);
    }
}

void WalkerData::walk(const Vec3& horizontal_way) {
    const Vec3& up = person_.up();
    const auto on_floor = [&](const Vec3& way) {
        return way - (dot(way, ground_normal_) / dot(up, ground_normal_)) * up;
    };
    ClipPlanes planes;
    Vec3 left = horizontal_way;
    for (int turns = 0; turns < 8 && length(left) > 0; ++turns) {
        const Advance step = advance(on_floor(left));
        left = (1 - step.share) * left;
        if (!step.hit || step.overlaps)
            break;
        const Vec3& normal = step.impact.normal;
        if (person_.is_flat(normal)) { // a ramp
            ground_normal_ = normal;
            left = planes.clipped(left);
            continue;
        }
        double share = 0;
        if (climb(left, share)) {
            left = (1 - share) * left;
            continue;
        }
        state_.blocked = true;
        const Vec3 wall = normalized_or_zero(person_.horizontal(normal));
        if (planes.full() || length(wall) == 0)
            break;
        planes.add(wall);
        left = planes.clipped(left);
    }
    if (!state_.waits && !must_settle_ && !stand()) {
        state_.on_ground = false;
        rising_ = 0;
    }
}

bool WalkerData::stand() {
    const WalkerOptions& o = person_.options();
    Vec3 feet = state_.feet;
    const double down = o.step_height + 2 * o.skin;
    const Advance step = person_.advance(body(), feet, -down * person_.up());
    if (step.waits) {
        state_.waits = true;
        return true; // the ground is not in memory
    }
    if (step.overlaps) {
        must_settle_ = true;
        return true;
    }
    if (!step.hit || !person_.can_stand_on(step.impact, feet))
        return false;
    arrive(feet);
    state_.on_ground = true;
    ground_normal_ = person_.is_flat(step.impact.normal) ? step.impact.normal : person_.up();
    ground_height_ = dot(step.impact.point_part, person_.up());
    if (step.distance < 0.9 * o.skin) // restores the skin
        (void)advance((o.skin - step.distance) * person_.up());
    return true;
}

bool WalkerData::climb(const Vec3& way, double& share) {
    constexpr double kLeastProgress = 1e-3; // of the radius
    const WalkerOptions& o = person_.options();
    const Vec3& up = person_.up();
    if (o.step_height == 0)
        return false;
    Vec3 feet = state_.feet;
    const Vec3 before = feet;
    const Advance rise = person_.advance(body(), feet, (o.step_height + 2 * o.skin) * up);
    const Vec3 raised = feet;
    const double risen = dot(raised - before, up);
    if (rise.waits || rise.overlaps || risen < o.skin)
        return false;
    const Advance forward = person_.advance(body(), feet, way);
    if (forward.waits || forward.share * length(way) < kLeastProgress * o.radius)
        return false;
    const Vec3 above = feet;
    const Advance down = person_.advance(body(), feet, -risen * up);
    if (down.waits)
        return false;
    if (down.hit) {
        const double height = dot(down.impact.point_part, up);
        if (height > ground_height_ + o.step_height + 0.1 * o.skin ||
            !person_.can_stand_on(down.impact, feet))
            return false;
        ground_height_ = std::max(ground_height_, height);
    }
    arrive(raised), arrive(above), arrive(feet);
    share = forward.share;
    ground_normal_ = up;
    return true;
}

void WalkerData::fall(const Vec3& way, double seconds) {
    const Vec3& up = person_.up();
    const double after = std::max(rising_ - person_.options().gravity * seconds, -kFastestFall);
    const double rise = 0.5 * (rising_ + after) * seconds;
    const double height = dot(state_.feet, up);
    Vec3 left = way + rise * up;
    bool hit = false;
    ClipPlanes planes;
    while (length(left) > 0) {
        const Advance step = advance(left);
        if (!step.hit || step.overlaps)
            break;
        hit = true;
        left = (1 - step.share) * left;
        const Vec3& normal = step.impact.normal;
        if (dot(left, up) <= 0 && person_.can_stand_on(step.impact, state_.feet)) {
            state_.on_ground = true, rising_ = 0;
            ground_normal_ = person_.is_flat(normal) ? normal : up;
            ground_height_ = dot(step.impact.point_part, up);
            if (length(person_.horizontal(left)) > 0)
                walk(person_.horizontal(left));
            return;
        }
        state_.blocked = state_.blocked || length(way) > 0;
        if (planes.full())
            break;
        // Nobody is lifted by walking against a slope that is too steep.
        if (dot(normal, up) > 0)
            planes.add(normalized_or_zero(person_.horizontal(normal)));
        Vec3 across = planes.clipped(person_.horizontal(left));
        planes.add(normal);
        left = planes.clipped(across + std::min(dot(left, up), rise > 0 ? rise : 0.0) * up);
    }
    const double moved = dot(state_.feet, up) - height;
    rising_ = hit && seconds > 0 ? std::min(after, moved / seconds) : after;
}

Walker::Walker(Walk& walk, const Vec3& feet, const WalkerOptions& options)
    : data_(std::make_unique<WalkerData>(walk, feet, options)) {}
Walker::~Walker() = default;
Walker::Walker(Walker&&) noexcept = default;
Walker& Walker::operator=(Walker&&) noexcept = default;

const WalkerState& Walker::step(const Vec3& wish, double seconds, bool duck, bool jump) {
    data_->step(wish, seconds, duck, jump);
    return data_->state();
}
const WalkerState& Walker::state() const {
    return data_->state();
}
Capsule Walker::capsule() const {
    return data_->capsule();
}
WalkerMode Walker::mode() const {
    return data_->mode();
}
void Walker::set_mode(WalkerMode mode) {
    data_->set_mode(mode);
}
void Walker::set_except(WalkPart part) {
    data_->person().set_except(part);
}
void Walker::move_to(const Vec3& feet) {
    data_->move_to(feet);
}

} // namespace abut
