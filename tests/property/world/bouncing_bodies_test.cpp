// Convex bodies that leave a floor while they spin: they are free until they meet it again, against fine
// steps.

#include <abut/world.h>

#include "math/transform.h"
#include "math/vector.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>

namespace abut::test {
namespace {

BodyId add_bouncing(World& world, int kind, const Pose& pose) {
    switch (kind) {
    case 0:
        return world.add(Box3{{-0.3, -0.2, -0.1}, {0.3, 0.2, 0.1}}, pose);
    case 1:
        return world.add(Convex(box_mesh({-0.3, -0.2, -0.1}, {0.3, 0.2, 0.1}).positions), pose);
    case 2:
        return world.add(Capsule{{{-0.3, 0, 0}, {0.3, 0, 0}}, 0.1}, pose);
    case 3:
        return world.add(Cylinder{{{0, 0, -0.3}, {0, 0, 0.3}}, 0.2}, pose);
    case 4:
        return world.add(Cone{{0, 0, 0.3}, {0, 0, -0.3}, 0.2}, pose);
    default:
        return world.add(Ellipsoid{{}, {0.3, 0.2, 0.1}}, pose);
    }
}

TEST(BouncingBodies, AreFreeUntilTheyMeetTheFloorAgain) {
    Random random(20261202);
    int free = 0, meet = 0, stopped = 0;
    for (int i = 0; i < many(400); ++i) {
        const int kind = i % 6;
        World world;
        if (random.chance(0.5))
            world.add(HalfSpace{{0, 0, 1}, 0}, {});
        else
            world.add(Box3{{-50, -50, -1}, {50, 50, 0}}, {});
        Pose pose = random.pose(0);
        pose.translation = {random.uniform(-5, 5), random.uniform(-5, 5), 2};
        const BodyId body = add_bouncing(world, kind, pose);
        pose.translation.z -= world.within(10).at(0).distance;
        world.move(body, pose);
        Motion motion = Motion::fixed(pose);
        motion.centre = pose.translation;
        motion.velocity = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(0, 1)};
        motion.angular_velocity = random.uniform(0, 3) * random.direction();
        const auto found = world.time_of_impact({{body, motion}});
        // In fine steps, from where they are clear of each other.
        constexpr int kSteps = 400;
        double least = HUGE_VAL, first_overlap = 2;
        for (int k = 1; k <= kSteps; ++k) {
            const Transform place = at(motion, double(k) / kSteps);
            const Vec3 p = apply(place, Vec3{});
            Pose there = pose; // the rotation, as a quaternion, by turning about the axis
            const double angle = length(motion.angular_velocity) * k / kSteps;
            const Vec3 axis = normalized_or_zero(motion.angular_velocity);
            const double c = std::cos(angle / 2), s = std::sin(angle / 2);
            const auto& q = pose.rotation;
            const Vec3 u = s * axis, v{q[1], q[2], q[3]}, w = c * v + q[0] * u + cross(u, v);
            there.rotation = {c * q[0] - dot(u, v), w.x, w.y, w.z};
            there.translation = p;
            world.move(body, there);
            const double gap = world.within(10).at(0).distance;
            least = std::min(least, gap - 1e-4 * std::min(1.0, 10.0 * k / kSteps));
            if (gap < -1e-7 && first_overlap > 1)
                first_overlap = double(k) / kSteps;
        }
        if (first_overlap <= 1) {
            ASSERT_EQ(found.size(), 1U) << i;
            EXPECT_LE(found[0].impact.time, first_overlap) << i;
            ++meet;
        } else if (least > 0) {
            ++free;
            stopped += found.empty() ? 0 : 1;
        }
    }
    std::cout << free << " free, of which " << stopped << " were stopped; " << meet << " meet\n";
    EXPECT_GT(free, many(400) / 10);
    EXPECT_GT(meet, many(400) / 40);
    EXPECT_LE(stopped, free / 20);
}

} // namespace
} // namespace abut::test
