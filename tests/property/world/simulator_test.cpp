// The simulator of the examples: it conserves what physics conserves, stacks and walls stand still,
// and nothing tunnels, sinks or leaves.

#include <abut/error.h>
#include <abut/progress.h>

#include "simulator/container.h"
#include "tests/property/world/box_of.h"
#include "tests/support/paths.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

using simulation::Body;
using simulation::Settings;
using simulation::Simulator;
using simulation::Stage;

constexpr double kStep = 1.0 / 60;
const Box3 kFloor{{-20, -20, -1}, {20, 20, 0}};

Vec3 angular_momentum(const Body& body) {
    const simulation::Matrix r = simulation::rotation_matrix(body.rotation);
    return body.mass.mass * cross(body.position, body.velocity) +
           r * (body.mass.inertia * (transposed(r) * body.spin));
}

struct Momentum {
    Vec3 linear, angular;
};
Momentum momentum(const Simulator& simulator) {
    Momentum sum;
    for (const Body& body : simulator.bodies()) {
        sum.linear = sum.linear + body.mass.mass * body.velocity;
        sum.angular = sum.angular + angular_momentum(body);
    }
    return sum;
}

TEST(Simulator, CollisionsConserveMomentum) {
    Random random(5401);
    std::size_t contacts = 0;
    for (int round = 0; round < many(10); ++round) {
        Simulator simulator({.gravity = {}});
        for (int i = 0; i < 12; ++i) {
            const Pose pose = random.pose(0.5);
            simulation::BodyNumber body = 0;
            if (i % 3 == 0)
                body = simulator.add(Sphere{{}, 0.1}, pose);
            else if (i % 3 == 1)
                body = simulator.add(Capsule{{{0, 0, -0.1}, {0, 0, 0.1}}, 0.05}, pose);
            else
                body = simulator.add(box_of(0.1, 0.07, 0.06), pose);
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
            contacts += simulator.contacts().touching_points();
        }
        EXPECT_NEAR(length(momentum(simulator).linear - before), 0, 1e-9);
    }
    EXPECT_GT(contacts, 70U);
}

TEST(Simulator, AFreeBodyKeepsItsEnergyAndItsAngularMomentum) {
    Simulator simulator({.gravity = {}, .sleep = false});
    simulator.add(box_of(0.5, 0.2, 0.1), {});
    Body& body = simulator.bodies()[0];
    body.spin = {0.1, 7, 0.2}; // near the middle axis, about which a rotation is unstable
    const Vec3 momentum_before = angular_momentum(body);
    const double energy = simulation::kinetic_energy(body);
    double least = 1; // of the spin along the middle axis
    for (int step = 0; step < 300; ++step) {
        simulator.step(kStep);
        least = std::min(least, body.spin.y / 7);
        EXPECT_NEAR(simulation::kinetic_energy(body), energy, 1e-10 * energy);
        EXPECT_LT(length(angular_momentum(body) - momentum_before),
                  1e-10 * length(momentum_before));
    }
    EXPECT_GT(least, 0); // the angular momentum does not turn over
}

TEST(Simulator, TheMassOfAMeshIsThatOfItsShape) {
    const Box3 box{{1, 2, 3}, {2, 2.5, 5}};
    const simulation::Mass shape = simulation::mass_of(box, 700),
                           mesh = simulation::mass_of(simulation::surface_of(box), 700);
    EXPECT_NEAR(mesh.mass, shape.mass, 1e-9);
    EXPECT_LT(length(mesh.centre - shape.centre), 1e-12);
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
        EXPECT_LT(length(mesh.inertia * axis - shape.inertia * axis), 1e-9);
    const Capsule capsule{{{0, 0, 0}, {1, 1, 1}}, 0.3};
    const simulation::Mass rod = simulation::mass_of(capsule, 1);
    const Vec3 axis = simulation::unit({1, 1, 1}), side = simulation::across(axis);
    EXPECT_LT(length(rod.inertia * axis), length(rod.inertia * side));
}

/// Simulates a scene, and expects that no step adds energy after the first tenth of a second.
void expect_no_growth_of_energy(Stage& stage, int steps, double tolerance) {
    Simulator& simulator = stage.simulator;
    double energy = simulator.energy();
    for (int step = 0; step < steps; ++step) {
        simulator.step(kStep);
        if (step >= 6) {
            EXPECT_LE(simulator.energy(), energy + tolerance) << "step " << step;
        }
        energy = simulator.energy();
    }
}

TEST(Simulator, EnergyNeverGrowsInAChain) {
    Stage stage;
    simulation::add_chain(stage, 20);
    const double start = stage.simulator.energy();
    expect_no_growth_of_energy(stage, many(300), 1e-9);
    EXPECT_LT(stage.simulator.energy(), start);
    EXPECT_EQ(stage.simulator.awake(), 20U); // it still swings
}

TEST(Simulator, EnergyNeverGrowsInAHeap) {
    Stage stage;
    simulation::fill_container(stage, 40);
    expect_no_growth_of_energy(stage, many(120), 1e-9);
}

/// Expects that the upper mesh ends at rest on the lower one.
void expect_mesh_rests(const simulation::PairOfMeshes& pair, double least_height) {
    Stage stage;
    simulation::add_pair(stage, pair);
    Simulator& simulator = stage.simulator;
    for (int step = 0; step < 600 && simulator.awake() > 0; ++step)
        simulator.step(kStep);
    EXPECT_EQ(simulator.awake(), 0U);
    EXPECT_GT(simulator.bodies()[2].position.z, least_height);
    EXPECT_LT(simulator.contacts().deepest(), 1e-3);
    const auto contacts = simulator.contacts().list();
    const abut::BodyId lower = simulator.bodies()[1].id, upper = simulator.bodies()[2].id;
    EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(), [&](const auto& contact) {
        return contact.pair.a == lower && contact.pair.b == upper;
    }));
}

TEST(Simulator, ABallRestsInTheDentOfADisc) {
    expect_mesh_rests(simulation::ball_on_disc(), 0.5);
}

TEST(Simulator, ABunnyRestsOnABunny) {
    const std::string file = std::string(ABUT_SHARED_DATA) + "/meshes/bunny.off";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << file << " is not there";
    expect_mesh_rests(simulation::pair_of_bunnies(read_mesh(file)), 1);
}

TEST(Simulator, RollingResistanceStopsABall) {
    // A solid ball loses its energy 0.7 m v^2 on the way, to a torque of `rolling` times its weight:
    // it rolls 0.7 v^2 r / (g rolling).
    for (const double rolling : {0.002, 0.01}) {
        Simulator simulator({.sleep = false});
        simulator.add(kFloor, {}, {.density = 0, .rolling = 0});
        const double radius = 0.2, speed = 0.5;
        const auto ball =
            simulator.add(Sphere{{}, radius}, {{-15, 0, radius}}, {.rolling = rolling});
        Body& body = simulator.bodies()[ball];
        body.velocity = {speed, 0, 0}, body.spin = {0, speed / radius, 0};
        for (int step = 0; step < 1800 && length(body.velocity) > 1e-6; ++step)
            simulator.step(kStep);
        EXPECT_NEAR(length(body.velocity), 0, 1e-6);
        const double way = 0.7 * speed * speed * radius / (9.81 * rolling);
        EXPECT_NEAR(body.position.x + 15, way, 0.05 * way) << "rolling " << rolling;
    }
}

/// A fast body that slides along another, whose surface is bent, is stopped at impacts that the
/// contacts do not have. It has to get on.
TEST(Simulator, ABodyThatSlidesAlongAMeshIsNotStuck) {
    const Model mesh(simulation::bumpy_ball(0.5));
    std::size_t touched = 0;
    for (const double height : {0.85, 0.9, 0.95})
        for (const double speed : {4, 8, 20})
            for (const double gravity : {0.0, 9.81}) {
                Simulator simulator({.gravity = {0, 0, -gravity}});
                simulator.add(mesh, {}, {.density = 0, .friction = 0});
                const auto moving = simulator.add(mesh, {{-2, 0, height}}, {.friction = 0});
                Body& body = simulator.bodies()[moving];
                body.velocity = {speed, 0, 0}, body.spin = {0, 3, 0};
                for (int step = 0; step < 60; ++step) {
                    const Vec3 before = body.position;
                    simulator.step(kStep);
                    EXPECT_GT(length(body.position - before), 1e-3 * kStep * length(body.velocity))
                        << "height " << height << " speed " << speed << " step " << step;
                }
                touched += length(body.velocity - Vec3{speed, 0, -gravity}) > 0.01 ? 1 : 0;
            }
    EXPECT_GT(touched, 12U);
}

/// A stack settles, falls asleep, and does not move from then on.
void expect_stack_stands(int high) {
    Stage stage;
    simulation::add_stack(stage, high);
    Simulator& simulator = stage.simulator;
    double energy = simulator.energy(), most_growth = 0;
    const auto simulate = [&](double seconds) {
        for (int step = 0; step < static_cast<int>(seconds * 60); ++step) {
            simulator.step(kStep);
            most_growth = std::max(most_growth, simulator.energy() - energy);
            energy = simulator.energy();
        }
    };
    const Vec3 start = simulator.bodies().back().position;
    simulate(4);
    const Vec3 settled = simulator.bodies().back().position;
    EXPECT_LT(length(settled - start), 0.001 * high); // its contacts are springs
    EXPECT_EQ(simulator.awake(), 0U);
    simulate(56);
    EXPECT_LT(length(simulator.bodies().back().position - settled), 1e-3);
    EXPECT_LT(most_growth, 1e-9 * energy);
}

TEST(Simulator, AStackOfTenStandsForAMinute) {
    expect_stack_stands(10);
}
TEST(Simulator, AStackOfTwentyStandsForAMinute) {
    expect_stack_stands(20);
}

TEST(Simulator, AStackThatIsNotLetToSleepStandsToo) {
    Stage stage({.sleep = false});
    simulation::add_stack(stage, 10);
    for (int step = 0; step < 60; ++step)
        stage.simulator.step(kStep);
    const Vec3 settled = stage.simulator.bodies().back().position;
    for (int step = 0; step < 240; ++step)
        stage.simulator.step(kStep);
    EXPECT_LT(length(stage.simulator.bodies().back().position - settled), 1e-3);
}

/// Bodies on a ground come to rest and stay there, without being put to sleep.
void expect_rest(Simulator& simulator) {
    for (int step = 0; step < 300; ++step)
        simulator.step(kStep);
    std::vector<Vec3> settled;
    for (const Body& body : simulator.bodies())
        settled.push_back(body.position);
    for (int step = 0; step < 300; ++step)
        simulator.step(kStep);
    for (std::size_t i = 0; i < settled.size(); ++i) {
        const Body& body = simulator.bodies()[i];
        EXPECT_LT(length(body.velocity), 0.01) << "body " << i;
        EXPECT_LT(length(body.position - settled[i]), 1e-3) << "body " << i;
    }
}

TEST(Simulator, APyramidOfBoxesRestsOnAHalfSpace) {
    for (const bool as_mesh : {false, true}) {
        SCOPED_TRACE(as_mesh);
        Simulator simulator({.sleep = false});
        simulator.add(HalfSpace{{0, 0, 1}, 0}, {}, {.density = 0});
        const Box3 box{{-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25}};
        for (int row = 0; row < 4; ++row)
            for (int i = 0; i < 4 - row; ++i) {
                const Pose pose{{0.55 * i + 0.275 * row, 0, 0.25 + 0.5 * row}, {1, 0, 0, 0}};
                if (as_mesh && row == 0)
                    simulator.add(Model(box_mesh(box.lower, box.upper)), pose);
                else
                    simulator.add(box, pose);
            }
        expect_rest(simulator);
    }
}

TEST(Simulator, CapsulesRestOnAFlatMesh) {
    Simulator simulator({.sleep = false});
    simulator.add(Model(grid_mesh(40, 40, false, false,
                                  [](double u, double v) {
                                      return Vec3{20 * u - 10, 20 * v - 10, 0};
                                  })),
                  {}, {.density = 0});
    for (int i = 0; i < 5; ++i)
        simulator.add(Capsule{{{-0.4, 0, 0}, {0.4, 0, 0}}, 0.1},
                      {{0.37 * i, 0.6 * i, 0.12}, {1, 0, 0, 0}}, {.rolling = 0.01});
    expect_rest(simulator);
}

TEST(Simulator, FrictionHoldsABoxUpToItsAngle) {
    for (const double slope : {0.3, 0.45, 0.55, 0.8}) {
        // The floor is tilted: its frame is kept and gravity turns.
        const double angle = std::atan(slope), g = 9.81;
        Simulator simulator({.gravity = {g * std::sin(angle), 0, -g * std::cos(angle)}});
        simulator.add(kFloor, {}, {.density = 0, .friction = 0.5});
        const auto box = simulator.add(box_of(0.3, 0.3, 0.1), {{-10, 0, 0.1}}, {.friction = 0.5});
        for (int step = 0; step < 60; ++step)
            simulator.step(kStep);
        const Body& body = simulator.bodies()[box];
        const double expected = slope < 0.5 ? 0 : g * (std::sin(angle) - 0.5 * std::cos(angle));
        EXPECT_NEAR(body.velocity.x, expected, 0.02 * expected + 0.005) << "slope " << slope;
        EXPECT_NEAR(body.velocity.y, 0, 0.005);
    }
}

TEST(Simulator, ABallBouncesToTheSquareOfItsRestitution) {
    for (const double bounce : {0.0, 0.5, 0.9, 1.0}) {
        Simulator simulator;
        simulator.add(kFloor, {}, {.density = 0});
        const auto ball = simulator.add(Sphere{{}, 0.2}, {{0, 0, 2.2}}, {.bounce = bounce});
        const Body& body = simulator.bodies()[ball];
        bool has_met = false;
        double highest = 0, energy = simulator.energy();
        for (int step = 0; step < 150; ++step) {
            simulator.step(1.0 / 120);
            has_met = has_met || body.velocity.z >= 0;
            if (has_met)
                highest = std::max(highest, body.position.z - 0.2);
            EXPECT_LE(simulator.energy(), energy + 1e-9) << "step " << step;
            energy = simulator.energy();
        }
        EXPECT_NEAR(highest, 2 * bounce * bounce, 0.08) << "bounce " << bounce;
    }
}

TEST(Simulator, AWallStandsAndFallsWhenHit) {
    Stage stage;
    simulation::add_wall(stage, 6, 8);
    Simulator& simulator = stage.simulator;
    std::vector<Vec3> start;
    for (const Body& body : simulator.bodies())
        start.push_back(body.position);
    const auto farthest = [&] {
        double most = 0;
        for (std::size_t i = 0; i < start.size(); ++i)
            most = std::max(most, length(simulator.bodies()[i].position - start[i]));
        return most;
    };
    for (int step = 0; step < 150; ++step)
        simulator.step(kStep);
    EXPECT_LT(farthest(), 0.005);
    EXPECT_EQ(simulator.awake(), 0U);
    const auto ball = simulator.add(Sphere{{}, 0.3}, {{0, -2, 1}}, {.density = 3000});
    simulator.bodies()[ball].velocity = {0, 15, 0};
    for (int step = 0; step < 60; ++step)
        simulator.step(kStep);
    EXPECT_GT(farthest(), 0.5);
}

TEST(Simulator, ABulletPassesNothing) {
    Stage stage;
    simulation::add_bullet(stage);
    for (int step = 0; step < 12; ++step)
        stage.simulator.step(kStep);
    const auto bodies = stage.simulator.bodies();
    for (int plate = 1; plate < 4; ++plate) { // the side of the plate that the ball is on
        const Vec3 normal = simulation::rotation_matrix(bodies[plate].rotation).x;
        EXPECT_LT(dot(normal, bodies[0].position - bodies[plate].position), 0) << plate;
    }
    EXPECT_GT(bodies[1].position.x, 0.1); // it has been hit
}

TEST(Simulator, AFastBallDoesNotTunnel) {
    for (const double speed : {5.0, 50.0, 500.0, 5000.0}) {
        Simulator simulator({.gravity = {}});
        simulator.add(box_of(0.005, 2, 2), {}, {.density = 0});
        const auto ball = simulator.add(Sphere{{}, 0.05}, {{-1, 0.1, 0.2}});
        simulator.bodies()[ball].velocity = {speed, 0, 0};
        for (int step = 0; step < 60; ++step)
            simulator.step(kStep);
        EXPECT_LT(simulator.bodies()[ball].position.x, 0) << "at speed " << speed;
        EXPECT_NEAR(simulator.bodies()[ball].velocity.x, 0, 1);
    }
}

TEST(Simulator, NothingSinksOrLeavesTheContainer) {
    constexpr int kBodies = 60;
    Stage stage;
    simulation::fill_container(stage, kBodies);
    Simulator& simulator = stage.simulator;
    const double start = simulator.energy();
    for (int step = 0; step < 240; ++step)
        simulator.step(kStep);
    const double w = simulation::half_width(kBodies);
    double fastest = 0;
    for (std::size_t i = 5; i < simulator.bodies().size(); ++i) {
        const Body& body = simulator.bodies()[i];
        EXPECT_GT(body.position.z, 0.04) << "body " << i << " has sunk";
        EXPECT_LT(std::max(std::abs(body.position.x), std::abs(body.position.y)), w)
            << "body " << i << " has left";
        fastest = std::max(fastest, length(body.velocity));
    }
    EXPECT_LT(simulator.contacts().deepest(), 0.01); // a twentieth of a body's size
    EXPECT_LT(fastest, 1);
    EXPECT_LT(simulator.energy(), start);
}

TEST(Simulator, ThreadsDoNotChangeARun) {
    std::vector<Vec3> places[2];
    for (const int threads : {1, 4}) {
        set_threads(threads);
        Stage stage;
        simulation::fill_container(stage, 40);
        for (int step = 0; step < 60; ++step)
            stage.simulator.step(kStep);
        for (const Body& body : stage.simulator.bodies())
            places[threads == 1 ? 0 : 1].push_back(body.position);
    }
    set_threads(0);
    EXPECT_EQ(places[0], places[1]);
}

TEST(Simulator, RefusesWhatIsNoBody) {
    Simulator simulator;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(simulator.add(Sphere{{}, 0}, {}), Error);     // no volume
    EXPECT_THROW(simulator.add(Sphere{{}, 1e-60}, {}), Error); // its inertia is 0 to rounding
    EXPECT_THROW(simulator.add(box_of(1, 1e-60, 1e-60), {}), Error);
    EXPECT_THROW(simulator.add(Box3{{0, 0, 0}, {1, 1, 0}}, {}), Error);
    EXPECT_THROW(simulator.add(Sphere{{}, 1}, {{nan, 0, 0}}), Error);
    EXPECT_THROW(simulator.add(Sphere{{}, 1}, {}, {.density = -1}), Error);
    EXPECT_THROW(simulator.add(Sphere{{}, 1}, {}, {.friction = nan}), Error);
    EXPECT_THROW(simulator.add(Sphere{{}, 1}, {}, {.bounce = 2}), Error);
    EXPECT_THROW(simulator.add(Sphere{{}, 1}, {}, {.rolling = -1}), Error);
    Mesh open = simulation::surface_of(box_of(1, 1, 1));
    for (auto& triangle : open.triangles)
        std::swap(triangle[0], triangle[1]);
    EXPECT_THROW(simulator.add(Model(open), {}), Error); // inside out
    EXPECT_EQ(simulator.bodies().size(), 0U);
    EXPECT_THROW(simulator.step(-1), Error);
    const auto ball = simulator.add(Sphere{{}, 1}, {});
    EXPECT_THROW(simulator.join(simulation::JointKind::ball, ball, ball, {}), Error);
    simulator.step(kStep);
    EXPECT_NEAR(simulator.bodies()[ball].velocity.z, -9.81 * kStep, 1e-12);
}

TEST(Simulator, RefusesSettingsAndNumbersThatMeanNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(Simulator({.gravity = {0, 0, nan}}), Error);
    EXPECT_THROW(Simulator({.substeps = 0}), Error);
    EXPECT_THROW(Simulator({.margin = -0.01}), Error);
    EXPECT_THROW(Simulator({.contact_hertz = nan}), Error);
    EXPECT_THROW(Simulator({.sleep_speed = HUGE_VAL}), Error);
    Simulator simulator;
    const auto a = simulator.add(Sphere{{}, 1}, {}), b = simulator.add(Sphere{{}, 1}, {{3, 0, 0}});
    const auto ball = simulation::JointKind::ball;
    EXPECT_THROW(simulator.join(ball, a, b + 1, {}), Error);
    EXPECT_THROW(simulator.join(ball, a, b, {{nan, 0, 0}}), Error);
    EXPECT_THROW(simulator.join(ball, a, b, {{}, {0, 0, HUGE_VAL}}), Error);
    EXPECT_THROW(simulator.wake(b + 1), Error);
    EXPECT_TRUE(simulator.joints().empty());
    simulator.join(ball, a, b, {{1.5, 0, 0}});
    EXPECT_EQ(simulator.joints().size(), 1U);
}

} // namespace
} // namespace abut::test
