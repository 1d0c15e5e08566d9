#include "world/schedule/course.h"

#include "rigid/shapes/shape_arguments.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// How far the caller's rounding may move a body off its course, relative to the coordinates, and
/// how far it may turn it, in radians.
constexpr double kOffCourse = 0x1p-48;
constexpr double kOffTurn = 0x1p-42;

Vec3 origin_of(const Body& body) {
    const auto& m = body.world_from_body.m;
    return {m[9], m[10], m[11]};
}

Vec3 way_after(const Vec3& velocity, const Vec3& acceleration, double t) {
    return t * velocity + (0.5 * t * t) * acceleration;
}

/// A rotation by |turn| radians about turn.
class Rotation {
public:
    explicit Rotation(const Vec3& turn) {
        const double angle = length(turn);
        if (angle == 0)
            return;
        axis_ = (1 / angle) * turn;
        const double half = std::sin(0.5 * angle);
        sine_ = std::sin(angle), versine_ = 2 * half * half;
    }
    [[nodiscard]] Vec3 operator()(const Vec3& v) const {
        const Vec3 across = cross(axis_, v);
        return v + sine_ * across + versine_ * cross(axis_, across);
    }

private:
    Vec3 axis_;
    double sine_ = 0, versine_ = 0;
};

/// Whether the body's axes are the earlier ones, turned by `turn` and by at most `most` radians more.
/// A rotation by an angle x changes the three columns of a rotation by 2 sqrt(2) sin(x / 2) together,
/// which is at most sqrt(2) x.
bool keeps_turn(const std::array<double, 9>& then, const Body& body, const Vec3& turn,
                double most) {
    const auto& now = body.world_from_body.m;
    const bool turns = turn != Vec3{};
    if (!turns && std::equal(then.begin(), then.end(), now.begin()))
        return true;
    const Rotation rotation(turn);
    double change_sq = 0;
    for (std::size_t i = 0; i < 9; i += 3) {
        const Vec3 column{then[i], then[i + 1], then[i + 2]};
        change_sq +=
            length_sq(Vec3{now[i], now[i + 1], now[i + 2]} - (turns ? rotation(column) : column));
    }
    return change_sq <= 2 * most * most;
}

/// How far the body may depart from its known motion in a span of time, and how far it may turn
/// beside its known turn. Times count from `since`.
double most_way(const Course& course, double from, double to) {
    return (to - from) * (course.speed + 0.5 * (from + to) * course.bounds.acceleration_bound);
}
double most_turn(const Course& course, double from, double to) {
    return (to - from) *
           (course.bounds.angular_speed + 0.5 * (from + to) * course.bounds.angular_acceleration);
}

} // namespace

void begin_course(Course& course, const Body& body, double now) {
    const double t = now - course.since;
    SpeedBounds& bounds = course.bounds;
    bounds.velocity = bounds.velocity + t * bounds.acceleration;
    bounds.angular_speed += t * bounds.angular_acceleration;
    course.speed += t * bounds.acceleration_bound;
    course.reshaped = course.reshaped || course.reach < 0 || course.generation != body.generation ||
                      course.shape_version != body.shape_version;
    note_place(course, body, now);
    course.since = now;
    course.origin = course.seen_origin, course.linear = course.seen_linear;
    course.reach = reach_from(body.shape, body.own_bounds, {});
    course.placement = body.placement;
    course.generation = body.generation, course.shape_version = body.shape_version;
}

bool keeps_course(const Course& course, const Body& body, double now) {
    const double t = now - course.since, seen = course.seen - course.since;
    const SpeedBounds& bounds = course.bounds;
    const Vec3 is = origin_of(body),
               expected = course.origin + way_after(bounds.velocity, bounds.acceleration, t);
    const double rounding = kOffCourse * (max_abs(is) + max_abs(expected));
    const double most = most_way(course, 0, t), most_angle = most_turn(course, 0, t);
    if (course.shape_version != body.shape_version ||
        !(length_sq(is - expected) <= (most + rounding) * (most + rounding)) ||
        !keeps_turn(course.linear, body, t * bounds.angular_velocity, most_angle + kOffTurn))
        return false;
    // A known motion allows only rounding, now and when the body was last seen. So the two tests
    // imply what follows.
    if (most == 0 && most_angle == 0)
        return true;
    const Vec3 &was = course.seen_origin,
               before = course.origin + way_after(bounds.velocity, bounds.acceleration, seen);
    const double earlier = kOffCourse * (max_abs(was) + max_abs(before)),
                 most_step = most_way(course, seen, t) + rounding + earlier;
    return length_sq((is - was) - (expected - before)) <= most_step * most_step &&
           keeps_turn(course.seen_linear, body, (t - seen) * bounds.angular_velocity,
                      most_turn(course, seen, t) + 2 * kOffTurn);
}

void note_place(Course& course, const Body& body, double now) {
    course.seen = now;
    course.seen_origin = origin_of(body);
    std::copy_n(body.world_from_body.m.begin(), 9, course.seen_linear.begin());
}

bool follows(const Course& course, const SpeedBounds& bounds, double now) {
    const SpeedBounds& old = course.bounds;
    const double t = now - course.since;
    const Vec3 off = bounds.velocity - old.velocity - t * old.acceleration;
    return bounds.acceleration == old.acceleration &&
           bounds.acceleration_bound <= old.acceleration_bound &&
           length(off) <=
               course.speed + old.acceleration_bound * t + kOffCourse * length(bounds.velocity) &&
           bounds.angular_velocity == old.angular_velocity &&
           bounds.angular_speed <= old.angular_speed + t * old.angular_acceleration &&
           bounds.angular_acceleration <= old.angular_acceleration;
}

bool repeats(const Course& course, const SpeedBounds& bounds) {
    const SpeedBounds& old = course.bounds;
    return course.speed == 0 && old.acceleration_bound == 0 && old.angular_acceleration == 0 &&
           bounds.angular_speed == old.angular_speed;
}

CourseNow course_at(const Course& course, double now) {
    const double t = now - course.since;
    const SpeedBounds& bounds = course.bounds;
    return {bounds.velocity + t * bounds.acceleration,
            bounds.acceleration,
            course.speed + t * bounds.acceleration_bound,
            bounds.acceleration_bound,
            {bounds.angular_velocity, bounds.angular_speed + t * bounds.angular_acceleration,
             bounds.angular_acceleration, course.reach}};
}

bool is_prescribed(const CourseNow& course) {
    return course.speed == 0 && course.acceleration_bound == 0 && course.turn.speed == 0 &&
           course.turn.acceleration == 0;
}

bool is_prescribed(const Course& course) {
    const SpeedBounds& bounds = course.bounds;
    return course.speed == 0 && bounds.acceleration_bound == 0 && bounds.angular_speed == 0 &&
           bounds.angular_acceleration == 0;
}

RelativeMotion relative_motion(const CourseNow& a, const CourseNow& b) {
    const double rounding = kScheduleRounding * (length(a.velocity) + length(b.velocity));
    return {a.velocity - b.velocity,
            a.acceleration - b.acceleration,
            a.speed + b.speed + rounding,
            a.acceleration_bound + b.acceleration_bound,
            a.turn,
            b.turn,
            is_prescribed(a) && is_prescribed(b) && a.acceleration == b.acceleration};
}

bool is_at_rest(const CourseNow& course) {
    const TurnBounds& turn = course.turn;
    return course.velocity == Vec3{} && course.acceleration == Vec3{} && course.speed == 0 &&
           course.acceleration_bound == 0 && turn.velocity == Vec3{} && turn.speed == 0 &&
           turn.acceleration == 0;
}

Box3 swept_box(const CourseNow& course, const Vec3& origin, const Box3& box, double span) {
    const Vec3 all{kNoCollision, kNoCollision, kNoCollision};
    const bool has_end = course.turn.reach < kNoCollision; // false: a half-space
    if (is_at_rest(course))
        return grown(box,
                     kScheduleRounding * (max_abs(origin) + (has_end ? course.turn.reach : 0)));
    if (!has_end)
        return {-all, all};
    const double acceleration = length(course.acceleration);
    const double most = length(course.velocity) + acceleration * span;
    // The path is a parabola. Between its ends, it deviates from the chord by at most the sagitta.
    const double sagitta = acceleration * span * span / 8;
    const TurnBounds& turn = course.turn;
    const double angle =
        span * (length(turn.velocity) + turn.speed + 0.5 * span * turn.acceleration);
    const double by = span * (course.speed + 0.5 * span * course.acceleration_bound) + sagitta +
                      kScheduleRounding * (most * span + max_abs(origin) + turn.reach);
    // A turning body stays within a ball, and each of its points near its place.
    const double turned = std::min(angle, 2.0) * turn.reach;
    const Vec3 ball{turn.reach, turn.reach, turn.reach}, near{turned, turned, turned};
    const Vec3 lower = max(min(box.lower, origin - ball), box.lower - near),
               upper = min(max(box.upper, origin + ball), box.upper + near);
    const Vec3 way = way_after(course.velocity, course.acceleration, span), margin{by, by, by};
    const Box3 swept{min(lower, lower + way) - margin, max(upper, upper + way) + margin};
    const bool is_box = swept.lower.x <= swept.upper.x && swept.lower.y <= swept.upper.y &&
                        swept.lower.z <= swept.upper.z;
    return is_box ? swept : Box3{-all, all}; // bounds so large that they overflow
}

} // namespace abut
