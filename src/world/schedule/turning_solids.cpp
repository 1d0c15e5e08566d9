#include "world/schedule/turning_solids.h"

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

} // namespace

double least_room_after(double time, const TurningSolid& a, const TurningSolid& b, const Vec3& n) {
    const Vec3 from = a.solid.centre;
    return -highest_after(time, b, -n, from) - highest_after(time, a, n, from) -
           off_tangent(time, a, n) - off_tangent(time, b, n);
}

double time_with_room(const TurningSolid& a, const TurningSolid& b, const Vec3& n, double margin,
                      double horizon) {
    constexpr int kMostRounds = 12;
    constexpr double kNearEnough = 0.9; // of the longest time that the bound proves
    const auto spare = [&](double time) { return least_room_after(time, a, b, n) - margin; };
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

} // namespace abut
