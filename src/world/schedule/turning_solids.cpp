#include "world/schedule/turning_solids.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// The height over a point that the solid reaches along a direction, if its points move on at the
/// velocities that they have now.
double highest_after(double time, const TurningSolid& body, const Vec3& n, const Vec3& from) {
    // n . (w x r) = (n x w) . r
    const Vec3 turned = time * cross(n, body.angular_velocity),
               top = body.solid.centre + farthest(body.solid, n + turned);
    return time * dot(n, body.velocity) + dot(n, top - from) + dot(turned, top - body.centre) +
           body.solid.radius;
}

/// Bounds the height by which turning takes points off their tangents.
double off_tangent(double time, const TurningSolid& body, const Vec3& n) {
    return 0.5 * time * time * length(body.angular_velocity) *
           length(cross(n, body.angular_velocity)) * body.swing;
}

/// A time up to which a concave function is above 0, at most `horizon`. 0 if it is not at 0.
template <typename Spare>
double time_above_zero(const Spare& spare, double horizon) {
    constexpr int kMostRounds = 12;
    constexpr double kNearEnough = 0.9; // of the longest such time
    double low = 0, at_low = spare(0), high = horizon, at_high = spare(horizon);
    if (!(at_low > 0))
        return 0;
    if (at_high > 0)
        return horizon;
    for (int round = 0; round < kMostRounds && low < kNearEnough * high; ++round) {
        // What is concave lies over its chord, so the chord's zero is proven, but for rounding. The
        // mean of times of unlike size is that of their magnitudes.
        const double chord = low + (high - low) * (at_low / (at_low - at_high));
        const bool along_chord = round % 2 == 0;
        const double time = along_chord ? chord : low > 0 ? std::sqrt(low * high) : 0.5 * high;
        const double found = spare(time);
        if (found > 0)
            low = time, at_low = found;
        else if (time < high)
            high = time, at_high = found;
    }
    return low;
}

} // namespace

double least_room_after(double time, const TurningSolid& a, const TurningSolid& b, const Vec3& n) {
    const Vec3 from = a.solid.centre;
    return -highest_after(time, b, -n, from) - highest_after(time, a, n, from) -
           off_tangent(time, a, n) - off_tangent(time, b, n);
}

double time_with_room(const TurningSolid& a, const TurningSolid& b, const Vec3& n, double margin,
                      double horizon) {
    return time_above_zero([&](double time) { return least_room_after(time, a, b, n) - margin; },
                           horizon);
}

double time_with_room_beside(const TurningSolid& a, const TurningSolid& b, const Vec3& n,
                             double margin, double horizon) {
    const Vec3 apart = b.centre - a.centre, flight = b.velocity - a.velocity;
    const TurningSolid seen{b.solid, b.centre, flight - cross(a.angular_velocity, apart),
                            b.angular_velocity - a.angular_velocity, b.swing};
    const double turn_a = length(a.angular_velocity), turn_b = length(b.angular_velocity),
                 across = length(cross(n, a.angular_velocity)), speed = length(flight);
    const Vec3 from = a.solid.centre;
    const double top_a = highest_after(0, a, n, from);
    return time_above_zero(
        [&](double time) {
            const double lever = length(apart) + time * speed + b.swing,
                         acceleration = turn_b * turn_b * b.swing +
                                        across * (2 * (speed + turn_b * b.swing) + turn_a * lever);
            return -highest_after(time, seen, -n, from) - top_a - 0.5 * time * time * acceleration -
                   margin;
        },
        horizon);
}

double longest_with_room(const TurningSolid& a, const TurningSolid& b, const Vec3& n, double margin,
                         double horizon) {
    double time = time_with_room(a, b, n, margin, horizon);
    if (time < horizon && a.angular_velocity != Vec3{})
        time = std::max(time, time_with_room_beside(a, b, n, margin, horizon));
    if (time < horizon && b.angular_velocity != Vec3{})
        time = std::max(time, time_with_room_beside(b, a, -n, margin, horizon));
    return time;
}

} // namespace abut
