#pragma once

#include <abut/motion.h>
#include <abut/world.h>

#include "math/vector.h"
#include "tests/support/world_script.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

/// Steps of a world, replayed at many times in between.
namespace abut::test {

/// A surface in a world, and its step.
struct Surface {
    BodyId body;
    MovingSurface& moving;
    std::vector<Vec3> start, end;
    Surface(BodyId id, MovingSurface& m)
        : body(id), moving(m), start(m.mesh.positions), end(m.end) {}
};

/// The pose of a moving body at a time.
inline Pose pose_at(const Motion& motion, double t) {
    const Transform now = at(motion, t);
    // The start's rotation, followed by the motion's rotation about its centre.
    const Vec3 w = t * motion.angular_velocity;
    const double angle = length(w), s = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
    const std::array<double, 4> turn{std::cos(angle / 2), s * w.x, s * w.y, s * w.z};
    const auto& q = motion.start.rotation;
    return {{now.m[9], now.m[10], now.m[11]},
            {turn[0] * q[0] - turn[1] * q[1] - turn[2] * q[2] - turn[3] * q[3],
             turn[0] * q[1] + turn[1] * q[0] + turn[2] * q[3] - turn[3] * q[2],
             turn[0] * q[2] - turn[1] * q[3] + turn[2] * q[0] + turn[3] * q[1],
             turn[0] * q[3] + turn[1] * q[2] - turn[2] * q[1] + turn[3] * q[0]}};
}

inline void move_to(World& world, const std::vector<BodyMotion>& motions,
                    const std::vector<Surface>& surfaces, double t) {
    for (const BodyMotion& each : motions)
        world.move(each.body, pose_at(each.motion, t));
    for (const Surface& each : surfaces) {
        std::vector<Vec3> now(each.start.size());
        for (std::size_t i = 0; i < now.size(); ++i)
            now[i] = (1 - t) * each.start[i] + t * each.end[i];
        each.moving.set_step(now, now);
        world.refresh(each.body);
    }
}

/// Moves everything back to the start of the step.
inline void move_back(World& world, const std::vector<BodyMotion>& motions,
                      const std::vector<Surface>& surfaces) {
    move_to(world, motions, {}, 0);
    for (const Surface& each : surfaces) {
        each.moving.set_step(each.start, each.end);
        world.refresh(each.body);
    }
}

} // namespace abut::test
