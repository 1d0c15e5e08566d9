// Impacts of fast bodies in the example simulator: only what a body reaches is hit, and the momenta of
// both bodies are conserved.

#include "simulator/scenes.h"
#include "tests/property/world/box_of.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using simulation::Body;
using simulation::Simulator;

constexpr double kImpactStep = 1.0 / 60;
const simulation::Settings kFreeSpace{.gravity = {}};

TEST(SimulatorImpacts, ABodyBehindAWallIsNotHit) {
    Simulator simulator(kFreeSpace);
    const auto ball = simulator.add(Sphere{{}, 0.05}, {{-1, 0, 0}}, {.density = 8000});
    const auto behind = simulator.add(box_of(0.1, 0.1, 0.1), {{1, 0, 0}});
    simulator.add(box_of(0.05, 1, 1), {}, {.density = 0});
    simulator.bodies()[ball].velocity = {300, 0, 0}; // 5 m in a step
    simulator.step(kImpactStep);
    EXPECT_NEAR(simulator.bodies()[ball].position.x, -0.1, 1e-3);
    EXPECT_NEAR(simulator.bodies()[ball].velocity.x, 0, 1e-9);
    EXPECT_EQ(length(simulator.bodies()[behind].velocity), 0);
}

TEST(SimulatorImpacts, TheOrderOfTheBodiesDoesNotDecideWhichIsHit) {
    for (const bool near_first : {true, false}) {
        Simulator simulator(kFreeSpace);
        const auto ball = simulator.add(Sphere{{}, 0.05}, {{-1, 0, 0}}, {.density = 8000});
        const auto first = simulator.add(box_of(0.05, 1, 1), {{near_first ? 0.0 : 1.0, 0, 0}}),
                   second = simulator.add(box_of(0.05, 1, 1), {{near_first ? 1.0 : 0.0, 0, 0}});
        const auto near = near_first ? first : second, far = near_first ? second : first;
        simulator.bodies()[ball].velocity = {300, 0, 0};
        simulator.step(kImpactStep);
        const auto bodies = simulator.bodies();
        const double together = 300 / (1 + bodies[near].mass.mass / bodies[ball].mass.mass);
        EXPECT_NEAR(bodies[ball].velocity.x, together, 1e-9);
        EXPECT_NEAR(bodies[near].velocity.x, together, 1e-9);
        EXPECT_EQ(length(bodies[far].velocity), 0);
    }
}

TEST(SimulatorImpacts, ABodyThatIsHitAsleepDoesNotMoveBeforeTheImpact) {
    Simulator simulator(kFreeSpace);
    const auto ball = simulator.add(Sphere{{}, 0.1}, {}, {.density = 8000});
    const auto sleeper = simulator.add(Sphere{{}, 0.1}, {{1, 0, 0}});
    simulator.bodies()[sleeper].asleep = true;
    const double late = 0.95; // the impact, as a share of the step
    simulator.bodies()[ball].velocity = {0.8 / (late * kImpactStep), 0, 0};
    simulator.step(kImpactStep);
    const Body& body = simulator.bodies()[sleeper];
    EXPECT_FALSE(body.asleep);
    EXPECT_GT(body.velocity.x, 40);
    EXPECT_LE(body.position.x - 1, (1 - late) * kImpactStep * body.velocity.x + 1e-6);
}

Vec3 angular_momentum_of(const Simulator& simulator) {
    Vec3 sum;
    for (const Body& body : simulator.bodies())
        sum = sum + body.mass.mass * cross(body.position, body.velocity) +
              simulation::world_inertia(body) * body.spin;
    return sum;
}

TEST(SimulatorImpacts, ImpactsOfSpinningBoxesConserveAngularMomentum) {
    Random random(5402);
    int hits = 0;
    const int rounds = many(100);
    for (int round = 0; round < rounds; ++round) {
        Simulator simulator(kFreeSpace);
        Pose left = random.pose(0.2), right = random.pose(0.2);
        left.translation.x -= 1, right.translation.x += 1;
        const auto a = simulator.add(box_of(0.3, 0.1, 0.05), left),
                   b = simulator.add(box_of(0.1, 0.3, 0.2), right);
        for (const auto body : {a, b})
            simulator.bodies()[body].spin = random.in_cube(20);
        simulator.bodies()[a].velocity = {90, 0, 0};
        simulator.bodies()[b].velocity = {-90, 0, 0};
        const Vec3 before = angular_momentum_of(simulator);
        simulator.step(kImpactStep);
        ASSERT_TRUE(simulator.contacts().list().empty());
        EXPECT_LT(length(angular_momentum_of(simulator) - before), 1e-9 * length(before))
            << "round " << round;
        hits += simulator.bodies()[a].velocity.x < 80 ? 1 : 0;
    }
    EXPECT_GT(hits, rounds / 4);
}

} // namespace
} // namespace abut::test
