#include "world/schedule/closing_time.h"

#include "math/vector.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// The first t > 0 with speed t + acceleration t^2 / 2 = gap, rounded down:
///
///     t = 2 gap / (v + sqrt(v^2 + 2 a gap)) = (sqrt(v^2 + 2 a gap) - v) / a.
///
/// The first form has no cancellation if v >= 0, the second if v < 0.
double first_root(double gap, double speed, double acceleration) {
    const double square = speed * speed + 2 * acceleration * gap;
    if (!(gap > 0) || !std::isfinite(square) || !std::isfinite(gap))
        return gap == kNoCollision ? kNoCollision : 0;
    if (square < 0 || (speed <= 0 && acceleration <= 0))
        return kNoCollision;
    // At least the speed, whose square may underflow; so may the other term.
    const double root = std::max(std::sqrt(square), acceleration < 0 ? 0.0 : std::abs(speed));
    if (!(root > 0))
        return 0;
    const double time = speed >= 0 ? 2 * gap / (speed + root) : (root - speed) / acceleration;
    return time * (1 - kScheduleRounding);
}

double turn_along(const TurnBounds& turn, const Vec3& n) {
    return turn.reach * (length(cross(n, turn.velocity)) + turn.speed +
                         kScheduleRounding * length(turn.velocity));
}

double turn_anyhow(const TurnBounds& turn) {
    return turn.reach * (length(turn.velocity) + turn.speed);
}

double turn_acceleration(const RelativeMotion& motion) {
    return motion.a.reach * motion.a.acceleration + motion.b.reach * motion.b.acceleration;
}

double speed_anyhow(const RelativeMotion& motion) {
    return length(motion.velocity) + motion.speed + turn_anyhow(motion.a) + turn_anyhow(motion.b);
}

double acceleration_anyhow(const RelativeMotion& motion) {
    return length(motion.acceleration) + motion.acceleration_bound + turn_acceleration(motion);
}

/// The first t > 0 with |between + t velocity| <= radii + t growth, rounded down. It is the root of
///
///     (velocity^2 - growth^2) t^2 + 2 away t + left = 0
double first_time_within(const Vec3& between, const Vec3& velocity, double radii, double growth) {
    const double distance = length(between), speed = length(velocity);
    const double left = length_sq(between) - radii * radii;
    const double away = dot(between, velocity) - radii * growth;
    const double square = away * away - (speed - growth) * (speed + growth) * left;
    if (!(left > 0) || !std::isfinite(square))
        return 0;
    const double terms = distance * speed + radii * growth, rounding = kScheduleRounding * terms;
    if (square < -rounding * rounding / kScheduleRounding)
        return kNoCollision;
    // Where balls graze each other the square cancels, so that its root has a larger error.
    constexpr double kSquareRounding = 0x1p-47;
    const double root = std::sqrt(std::max(square, 0.0) + kSquareRounding * terms * terms);
    const double sum = root - away + rounding;
    return sum > 0 ? left / sum * (1 - kScheduleRounding) : kNoCollision;
}

} // namespace

double time_along(const RelativeMotion& motion, const Vec3& n, double gap) {
    const double speed = dot(motion.velocity, n) + motion.speed + turn_along(motion.a, n) +
                         turn_along(motion.b, n) + kScheduleRounding * length(motion.velocity);
    const double acceleration = dot(motion.acceleration, n) + motion.acceleration_bound +
                                turn_acceleration(motion) +
                                kScheduleRounding * length(motion.acceleration);
    return first_root(gap, speed, acceleration);
}

double time_from_distance(const RelativeMotion& motion, double distance) {
    return first_root(distance, speed_anyhow(motion), acceleration_anyhow(motion));
}

double distance_closed(const RelativeMotion& motion, double time) {
    return time * (speed_anyhow(motion) + 0.5 * time * acceleration_anyhow(motion));
}

double time_of_balls(const RelativeMotion& motion, const Vec3& between, double size) {
    const double radii = motion.a.reach + motion.b.reach +
                         kScheduleRounding * (size + motion.a.reach + motion.b.reach);
    const double gap = length(between) - radii;
    if (!(gap > 0))
        return 0;
    const double acceleration = length(motion.acceleration) + motion.acceleration_bound;
    if (acceleration == 0)
        return first_time_within(between, motion.velocity, radii, motion.speed);
    // Up to any time T, the acceleration moves the bodies by at most acceleration T^2 / 2. That
    // enlarges the radii of balls that move uniformly.
    constexpr int kMostDoublings = 24;
    double best = first_root(gap, length(motion.velocity) + motion.speed, acceleration);
    for (int i = 0; i < kMostDoublings && best > 0 && best < kNoCollision; ++i) {
        const double until = 2 * best;
        const double free = first_time_within(
            between, motion.velocity, radii + 0.5 * until * until * acceleration, motion.speed);
        if (free < until)
            return std::max(best, free);
        best = until;
    }
    return best;
}

} // namespace abut
