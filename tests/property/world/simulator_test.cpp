// The simulator of the examples: it conserves momentum, and nothing tunnels, sinks or leaves.

#include "container.h"
#include "simulator.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

struct Momentum {
    Vec3 linear, angular;
};

Momentum momentum(drop::Simulator& simulator) {
    Momentum sum;
    for (const drop::RigidBody& body : simulator.bodies()) {
        const Transform& t = simulator.world().world_from_body(body.id);
        const Vec3 linear = body.inertia.mass * body.velocity;
        const Vec3 own = drop::turned_back(t, body.spin), &i = body.inertia.moments;
        sum.linear = sum.linear + linear;
        sum.angular = sum.angular + cross(body.pose.translation, linear) +
                      drop::turned(t, {i.x * own.x, i.y * own.y, i.z * own.z});
    }
    return sum;
}

TEST(Simulator, CollisionsConserveMomentum) {
    Random random(5401);
    int collisions = 0;
    for (int round = 0; round < many(30); ++round) {
        drop::Settings settings;
        settings.gravity = {};
        drop::Simulator simulator(settings);
        for (int i = 0; i < 12; ++i) {
            const Pose pose = random.pose(0.5);
            std::size_t body = 0;
            if (i % 3 == 0)
                body = simulator.add(Sphere{{}, 0.1}, pose, 1000);
            else if (i % 3 == 1)
                body = simulator.add(Capsule{{{0, 0, -0.1}, {0, 0, 0.1}}, 0.05}, pose, 1000);
            else
                body = simulator.add(Box3{{-0.1, -0.07, -0.06}, {0.1, 0.07, 0.06}}, pose, 1000);
            simulator.bodies()[body].velocity = -1.0 * pose.translation + random.in_cube(0.5);
            simulator.bodies()[body].spin = random.in_cube();
        }
        const Vec3 before = momentum(simulator).linear;
        for (int step = 0; step < 60; ++step) {
            const Momentum start = momentum(simulator);
            simulator.step(0);
            const Momentum end = momentum(simulator);
            EXPECT_NEAR(length(end.angular - start.angular), 0, 1e-9);
            simulator.step(1.0 / 240);
            collisions += static_cast<int>(simulator.world().collide().size());
        }
        const Vec3 after = momentum(simulator).linear;
        EXPECT_NEAR(length(after - before), 0, 1e-9);
    }
    EXPECT_GT(collisions, 200);
}

/// Runs a container full of bodies and expects all of them inside at the end.
void expect_all_inside(int bodies, double seconds) {
    drop::Simulator simulator;
    drop::fill_container(simulator, bodies);
    for (int step = 0; step < int(seconds * 120); ++step)
        simulator.step(1.0 / 120);
    const double w = drop::half_width(bodies);
    double deepest = 0, fastest = 0;
    for (const BodyGap& gap : simulator.world().penetration())
        deepest = std::max(deepest, -gap.distance);
    for (std::size_t i = 5; i < simulator.bodies().size(); ++i) {
        const drop::RigidBody& body = simulator.bodies()[i];
        const Vec3& p = body.pose.translation;
        EXPECT_GT(p.z, 0.04) << "body " << i << " has sunk";
        EXPECT_LT(std::max(std::abs(p.x), std::abs(p.y)), w) << "body " << i << " has left";
        fastest = std::max(fastest, length(body.velocity));
    }
    EXPECT_LT(deepest, 0.02); // a tenth of a body's size
    EXPECT_LT(fastest, 3);
}

TEST(Simulator, NothingSinksOrLeavesTheContainer) {
    expect_all_inside(120, 4);
}

TEST(Simulator, ABrickComesToRest) {
    drop::Simulator simulator;
    simulator.add(Box3{{-2, -2, -0.5}, {2, 2, 0.5}}, {{0, 0, -0.5}}, 0);
    const auto brick = simulator.add(Box3{{-0.1, -0.07, -0.06}, {0.1, 0.07, 0.06}},
                                     {{0, 0, 0.4}, {0.9, 0.3, 0.2, 0.1}}, 500);
    for (int step = 0; step < 480; ++step)
        simulator.step(1.0 / 120);
    const drop::RigidBody& body = simulator.bodies()[brick];
    EXPECT_LT(length(body.velocity), 0.05);
    EXPECT_LT(length(body.spin), 0.5);
    EXPECT_NEAR(body.pose.translation.z, 0.06, 0.05);
}

TEST(Simulator, AFastBallDoesNotTunnel) {
    for (const double speed : {5.0, 50.0, 500.0, 5000.0}) {
        drop::Settings settings;
        settings.gravity = {};
        drop::Simulator simulator(settings);
        simulator.add(Box3{{-0.005, -2, -2}, {0.005, 2, 2}}, {}, 0);
        const auto ball = simulator.add(Sphere{{}, 0.05}, {{-1, 0.1, 0.2}}, 500);
        simulator.bodies()[ball].velocity = {speed, 0, 0};
        for (int step = 0; step < 120; ++step)
            simulator.step(1.0 / 120);
        EXPECT_LT(simulator.bodies()[ball].pose.translation.x, 0) << "at speed " << speed;
        EXPECT_NEAR(simulator.bodies()[ball].velocity.x, 0, 1);
    }
}

} // namespace
} // namespace abut::test
