// Joints of the example simulator: they keep what they hold together, and add no energy.

#include "simulator/scenes.h"

#include <gtest/gtest.h>
#include <numbers>

namespace abut::test {
namespace {

using simulation::Body;
using simulation::JointKind;
using simulation::Simulator;
using simulation::Stage;

constexpr double kJointStep = 1.0 / 60;
const Box3 kBar{{-0.5, -0.1, -0.1}, {0.5, 0.1, 0.1}};

TEST(SimulatorJoints, AChainHangs) {
    Stage stage;
    simulation::add_chain(stage, 12);
    Simulator& simulator = stage.simulator;
    const double start = simulator.energy();
    double widest = 0;
    for (int step = 0; step < 180; ++step) {
        simulator.step(kJointStep);
        for (const simulation::Joint& joint : simulator.joints())
            widest = std::max(widest, joint.gap(simulator.bodies()));
        EXPECT_LE(simulator.energy(), start);
    }
    EXPECT_LT(widest, 0.01);
    // Its mean height has come down, and no link has left.
    EXPECT_LT(simulator.bodies().back().position.z, 0.25 * 14);
    EXPECT_LT(length(simulator.bodies().back().position - simulator.bodies()[0].position), 3.1);
}

TEST(SimulatorJoints, APendulumHasItsPeriod) {
    Simulator simulator;
    const auto hook = simulator.add(Sphere{{}, 0.05}, {}, {.density = 0});
    const auto bar = simulator.add(
        kBar, {{0.05, 0, -1},
               {std::cos(0.25 * std::numbers::pi), 0, std::sin(0.25 * std::numbers::pi), 0}});
    simulator.join(JointKind::hinge, hook, bar, {{0, 0, 0}, {0, 1, 0}});
    const Body& body = simulator.bodies()[bar];
    // Small swings: T = 2 pi sqrt(I / (m g r)).
    const double r = length(body.position), mass = body.mass.mass;
    const double inertia = mass / 12 * (1 + 0.04) + mass * r * r;
    const double period = 2 * std::numbers::pi * std::sqrt(inertia / (mass * 9.81 * r));
    int crossings = 0;
    double last = 0, first_time = 0, last_time = 0;
    for (int step = 0; step < 600; ++step) {
        simulator.step(kJointStep);
        const double x = body.position.x;
        if (last > 0 && x <= 0) {
            last_time = kJointStep * (step + x / (last - x));
            if (crossings++ == 0)
                first_time = last_time;
        }
        last = x;
    }
    ASSERT_GT(crossings, 3);
    EXPECT_NEAR((last_time - first_time) / (crossings - 1), period, 0.01 * period);
}

TEST(SimulatorJoints, AHingeKeepsItsAxis) {
    Simulator simulator;
    const auto post = simulator.add(kBar, {}, {.density = 0});
    const auto door = simulator.add(kBar, {{1, 0, 0}});
    simulator.join(JointKind::hinge, post, door, {{0.5, 0, 0}, {0, 0, 1}});
    simulator.bodies()[door].spin = {0, 0, 3}; // gravity bends the hinge
    for (int step = 0; step < 240; ++step) {
        simulator.step(kJointStep);
        EXPECT_LT(simulator.joints()[0].gap(simulator.bodies()), 2e-3);
        EXPECT_LT(simulator.joints()[0].twist(simulator.bodies()), 5e-3);
    }
    EXPECT_GT(simulator.bodies()[door].spin.z, 0.5); // it has not been braked
}

TEST(SimulatorJoints, ASliderKeepsItsLine) {
    Simulator simulator;
    const auto rail = simulator.add(kBar, {}, {.density = 0});
    const auto cart = simulator.add(kBar, {{2, 0, 0}});
    simulator.join(JointKind::slider, rail, cart, {{2, 0, 0}, {1, 0, 0}});
    simulator.bodies()[cart].velocity = {2, 0, 0};
    simulator.bodies()[cart].spin = {1, 1, 1};
    for (int step = 0; step < 120; ++step)
        simulator.step(kJointStep);
    const Body& body = simulator.bodies()[cart];
    EXPECT_NEAR(body.velocity.x, 2, 0.1);
    EXPECT_GT(body.position.x, 5);
    EXPECT_LT(simulator.joints()[0].gap(simulator.bodies()), 2e-3);
    EXPECT_LT(simulator.joints()[0].twist(simulator.bodies()), 2e-3);
}

TEST(SimulatorJoints, ACrankTurnsWithoutGainingEnergy) {
    Stage stage;
    simulation::add_crank(stage);
    Simulator& simulator = stage.simulator;
    simulator.step(kJointStep); // after it, the speeds agree with the joints
    const double start = simulator.energy();
    for (int step = 0; step < 300; ++step) {
        simulator.step(kJointStep);
        EXPECT_LT(simulator.energy(), 1.01 * start);
        for (const simulation::Joint& joint : simulator.joints())
            EXPECT_LT(joint.gap(simulator.bodies()), 2e-3);
    }
    EXPECT_GT(simulator.energy(), 0.8 * start);
}

TEST(SimulatorJoints, JoinedBodiesFallAsleepAndWakeTogether) {
    Simulator simulator;
    simulator.add(Box3{{-5, -5, -1}, {5, 5, 0}}, {}, {.density = 0});
    const auto a = simulator.add(kBar, {{0, 0, 0.1}}), b = simulator.add(kBar, {{1.1, 0, 0.1}});
    simulator.join(JointKind::ball, a, b, {{0.55, 0, 0.1}});
    for (int step = 0; step < 120; ++step)
        simulator.step(kJointStep);
    EXPECT_EQ(simulator.awake(), 0U);
    simulator.wake(b);
    simulator.step(kJointStep);
    EXPECT_EQ(simulator.awake(), 2U);
}

} // namespace
} // namespace abut::test
