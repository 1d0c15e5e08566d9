#include "world/schedule/prescribed_impact.h"

#include "math/vector.h"
#include "world/schedule/body_impact.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// The body's motion in a window of time, from t = 0 to 1.
Motion motion_in_window(const Body& body, const Vec3& velocity, const Vec3& turn, double window) {
    return {body.pose, body.pose.translation, window * velocity, window * turn};
}

} // namespace

double prescribed_free_time(const Body& a, const Body& b, const RelativeMotion& motion,
                            double most) {
    constexpr double kMostTurn = 3; // radians
    const double turn = std::max(length(motion.a.velocity), length(motion.b.velocity));
    // Velocities are rounded, by less than 2^-11 of motion.speed. What that adds to the way within
    // the window stays far below the tolerance of an impact.
    constexpr double kMostRounding = 0x1p-14;
    // The tolerance follows the smaller body. A half-space, which has no reach, is never that.
    const double size = std::min(motion.a.reach, motion.b.reach);
    const double window =
        std::min({most, turn > 0 ? kMostTurn / turn : kNoCollision,
                  motion.speed > 0 ? kMostRounding * size / motion.speed : kNoCollision});
    // Beyond these values a motion is refused; slow bodies are left to other bounds.
    if (!(window > 0 && window < 1e30) || !(window * length(motion.velocity) < 1e30))
        return 0;
    // Seen from a frame that moves with b's origin; it does not turn.
    const Motion of_a = motion_in_window(a, motion.velocity, motion.a.velocity, window),
                 of_b = motion_in_window(b, {}, motion.b.velocity, window);
    const Impact impact =
        body_impact({a.shape, a.own_bounds, of_a}, {b.shape, b.own_bounds, of_b}, {});
    return window * impact.time * (1 - kScheduleRounding);
}

} // namespace abut
