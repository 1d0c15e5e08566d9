// Scenes by which the author of a simulator judges contacts: slopes, stacks and ragdolls on every kind of
// ground, without putting bodies to sleep.

#include "simulator/scenes.h"
#include "tests/property/world/box_of.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

using simulation::Body;
using simulation::BodyNumber;
using simulation::JointKind;
using simulation::Simulator;

constexpr double kSceneStep = 1.0 / 60;

enum class Ground { half_space, box, flat_mesh, bumpy_mesh };
const char* name_of(Ground ground) {
    constexpr std::array kNames{"half-space", "box", "flat mesh", "bumpy mesh"};
    return kNames.at(static_cast<std::size_t>(ground));
}

void add_ground(Simulator& simulator, Ground ground, double friction) {
    const simulation::Material still{.density = 0, .friction = friction};
    const auto mesh = [](double height) {
        return Model(grid_mesh(40, 40, false, false, [=](double u, double v) {
            return Vec3{20 * u - 10, 20 * v - 10, height * std::sin(40 * u) * std::cos(37 * v)};
        }));
    };
    switch (ground) {
    case Ground::half_space:
        simulator.add(HalfSpace{{0, 0, 1}, 0}, {}, still);
        break;
    case Ground::box:
        simulator.add(Box3{{-20, -20, -1}, {20, 20, 0}}, {}, still);
        break;
    case Ground::flat_mesh:
        simulator.add(mesh(0), {}, still);
        break;
    case Ground::bumpy_mesh:
        simulator.add(mesh(0.05), {}, still);
        break;
    }
}

/// The fastest body after some seconds.
double speed_after(Simulator& simulator, double seconds) {
    for (int step = 0; step < static_cast<int>(std::lround(60 * seconds)); ++step)
        simulator.step(kSceneStep);
    double fastest = 0;
    for (const Body& body : simulator.bodies())
        fastest = std::max(fastest, length(body.velocity));
    return fastest;
}

TEST(SimulatorScenes, ABoxSlidesDownASlopeAsFarAsFrictionLetsIt) {
    // A slope of 20 degrees for 3 s: the ground keeps its frame, and gravity turns.
    const double angle = std::numbers::pi / 9, g = 9.81;
    for (const Ground ground : {Ground::half_space, Ground::box, Ground::flat_mesh})
        for (const double friction : {0.3, 0.5})
            for (const bool as_mesh : {false, true}) {
                SCOPED_TRACE(std::string(name_of(ground)) + (as_mesh ? ", mesh box" : ", box") +
                             ", friction " + std::to_string(friction));
                Simulator simulator(
                    {.gravity = {g * std::sin(angle), 0, -g * std::cos(angle)}, .sleep = false});
                add_ground(simulator, ground, friction);
                const Box3 shape = box_of(0.3, 0.3, 0.1);
                const Pose start{{-3, 0.1, 0.1}, {1, 0, 0, 0}};
                const simulation::Material material{.friction = friction};
                const BodyNumber box =
                    as_mesh
                        ? simulator.add(Model(box_mesh(shape.lower, shape.upper)), start, material)
                        : simulator.add(shape, start, material);
                static_cast<void>(speed_after(simulator, 3));
                const double way = length(simulator.bodies()[box].position - start.translation);
                const double free = std::sin(angle) - friction * std::cos(angle);
                EXPECT_NEAR(way, free > 0 ? 4.5 * g * free : 0, free > 0 ? 0.03 : 0.002);
            }
}

TEST(SimulatorScenes, StacksOfMeshesStandAsThoseOfBoxesDo) {
    for (const Ground ground : {Ground::half_space, Ground::box, Ground::flat_mesh}) {
        SCOPED_TRACE(name_of(ground));
        Simulator simulator({.sleep = false});
        add_ground(simulator, ground, 0.5);
        const Box3 shape = box_of(0.25, 0.25, 0.25);
        const Model mesh(box_mesh(shape.lower, shape.upper));
        for (int i = 0; i < 6; ++i)
            simulator.add(mesh, {{0.1, 0.2, 0.25 + 0.5 * i}, {1, 0, 0, 0}});
        static_cast<void>(speed_after(simulator, 2));
        std::vector<Vec3> settled;
        for (const Body& body : simulator.bodies())
            settled.push_back(body.position);
        EXPECT_LT(speed_after(simulator, 6), 1e-3);
        for (std::size_t i = 0; i < settled.size(); ++i)
            EXPECT_LT(length(simulator.bodies()[i].position - settled[i]), 1e-3) << "body " << i;
    }
}

/// A trunk, a head, two arms and two legs of two capsules each, that lie down from a fall.
void add_ragdoll(Simulator& simulator, const Vec3& at) {
    const simulation::Material soft{.friction = 0.6, .rolling = 0.02};
    const auto limb = [&](const Vec3& from, const Vec3& to, double radius) {
        const Vec3 middle = 0.5 * from + 0.5 * to;
        return simulator.add(Capsule{{from - middle, to - middle}, radius},
                             {at + middle, {1, 0, 0, 0}}, soft);
    };
    const BodyNumber trunk = limb({0, 0, 0}, {0.5, 0, 0}, 0.15),
                     head = limb({0.78, 0, 0}, {0.84, 0, 0}, 0.11);
    simulator.join(JointKind::ball, trunk, head, {at + Vec3{0.66, 0, 0}});
    for (const double side : {-1.0, 1.0}) {
        const BodyNumber upper = limb({0.45, 0.25 * side, 0}, {0.45, 0.5 * side, 0}, 0.06),
                         lower = limb({0.45, 0.62 * side, 0}, {0.45, 0.85 * side, 0}, 0.05);
        simulator.join(JointKind::ball, trunk, upper, {at + Vec3{0.45, 0.18 * side, 0}});
        simulator.join(JointKind::ball, upper, lower, {at + Vec3{0.45, 0.56 * side, 0}});
        const BodyNumber thigh = limb({-0.22, 0.1 * side, 0}, {-0.55, 0.1 * side, 0}, 0.08),
                         shin = limb({-0.7, 0.1 * side, 0}, {-1, 0.1 * side, 0}, 0.06);
        simulator.join(JointKind::ball, trunk, thigh, {at + Vec3{-0.16, 0.1 * side, 0}});
        simulator.join(JointKind::ball, thigh, shin, {at + Vec3{-0.63, 0.1 * side, 0}});
    }
}

TEST(SimulatorScenes, RagdollsComeToRest) {
    for (const Ground ground :
         {Ground::half_space, Ground::box, Ground::flat_mesh, Ground::bumpy_mesh}) {
        SCOPED_TRACE(name_of(ground));
        Simulator simulator({.sleep = false});
        add_ground(simulator, ground, 0.6);
        for (int i = 0; i < 2; ++i)
            add_ragdoll(simulator, {0.3 + 3.1 * i, 0.2, 0.6});
        EXPECT_LT(speed_after(simulator, 10), 0.01);
        for (std::size_t i = 1; i < simulator.bodies().size(); ++i)
            EXPECT_GT(simulator.bodies()[i].position.z, -0.1) << "body " << i;
    }
}

} // namespace
} // namespace abut::test
