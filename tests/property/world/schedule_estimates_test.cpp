// What the schedule estimates, against small steps of the motion; and its reports where boxes
// overlap all the time, against all pairs.

#include <abut/deformable.h>
#include <abut/error.h>
#include <abut/progress.h>
#include <abut/world.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <numbers>

namespace abut::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Mesh ring(double radius, double tube) {
    constexpr std::uint32_t kRows = 12, kColumns = 6;
    Mesh mesh;
    for (std::uint32_t i = 0; i < kRows; ++i)
        for (std::uint32_t k = 0; k < kColumns; ++k) {
            const double u = 2 * std::numbers::pi * i / kRows,
                         v = 2 * std::numbers::pi * k / kColumns;
            const double r = radius + tube * std::cos(v);
            mesh.positions.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
            const std::uint32_t i1 = (i + 1) % kRows, k1 = (k + 1) % kColumns;
            mesh.triangles.push_back({i * kColumns + k, i1 * kColumns + k, i1 * kColumns + k1});
            mesh.triangles.push_back({i * kColumns + k, i1 * kColumns + k1, i * kColumns + k1});
        }
    return mesh;
}

using Quaternion = std::array<double, 4>;

Quaternion product(const Quaternion& p, const Quaternion& q) {
    return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}
Quaternion rotation(const Vec3& turn) {
    const double angle = length(turn), s = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
    return {std::cos(angle / 2), s * turn.x, s * turn.y, s * turn.z};
}

/// A body whose motion makes use of all that its bounds allow: accelerations and turns beside the
/// known ones, along a direction of its own.
struct Rover {
    BodyId id;
    Pose start;
    SpeedBounds bounds;
    Vec3 push, axis; ///< unit vectors, or zero
    double since = 0;

    [[nodiscard]] Pose at(double now) const {
        const double t = now - since;
        const Vec3 a = bounds.acceleration + (1 - 1e-9) * bounds.acceleration_bound * push;
        // One of the two turns is zero, so that their sum is a rotation about one axis.
        const double angle =
            (1 - 1e-9) * (bounds.angular_speed * t + 0.5 * t * t * bounds.angular_acceleration);
        const Vec3 turn = t * bounds.angular_velocity + angle * axis;
        return {start.translation + t * bounds.velocity + (0.5 * t * t) * a,
                product(rotation(turn), start.rotation)};
    }
};

/// Rings, tetrahedra and solids near each other.
class Rovers {
public:
    Rovers(Random& random, World& world, int count, double half)
        : random_(random), world_(world), half_(half), ring_(ring(0.3, 0.06)),
          solid_(ring(0.2, 0.1).positions) {
        for (int i = 0; i < count; ++i)
            add();
    }

    void add() {
        Pose pose = random_.pose(1);
        pose.translation = half_ * random_.in_cube();
        Rover rover;
        switch (random_.integer(0, 5)) {
        case 0:
            rover.id = world_.add(solid_, pose);
            break;
        case 1:
            rover.id = world_.add(Capsule{{{-0.2, 0, 0}, {0.2, 0, 0}}, 0.05}, pose);
            break;
        case 2:
            rover.id = world_.add(Box3{{-0.1, -0.05, -0.2}, {0.15, 0.05, 0.1}}, pose);
            break;
        default:
            rover.id = world_.add(ring_, pose);
        }
        rover.start = pose;
        rovers.push_back(rover);
        steer(rovers.back());
    }
    /// Gives a body other bounds. All kinds occur, zero among them.
    void steer(Rover& rover) {
        const auto some = [&](double most) {
            return random_.chance(0.5) ? 0 : random_.uniform(0, most);
        };
        rover.start = rover.at(now_);
        rover.since = now_;
        rover.bounds.velocity = some(1) * random_.direction();
        rover.bounds.acceleration = gravity_ + some(1) * random_.direction();
        rover.bounds.acceleration_bound = some(1);
        const bool known = random_.chance(0.3);
        rover.bounds.angular_velocity = known ? some(3) * random_.direction() : Vec3{};
        rover.bounds.angular_speed = known ? 0 : some(3);
        rover.bounds.angular_acceleration = known ? 0 : some(3);
        rover.push = random_.direction(), rover.axis = random_.direction();
        world_.set_speed(rover.id, rover.bounds);
    }
    /// Leaves nothing unknown of the body's motion.
    void prescribe(Rover& rover) {
        rover.start = rover.at(now_), rover.since = now_;
        rover.bounds = {.velocity = random_.in_cube(),
                        .acceleration = gravity_,
                        .angular_velocity = 2 * random_.in_cube()};
        world_.set_speed(rover.id, rover.bounds);
    }
    void turn_back() {
        for (Rover& rover : rovers)
            if (random_.chance(0.01) ||
                max_abs(world_.world_from_body(rover.id).m[9] * Vec3{1, 0, 0}) > 2 * half_)
                steer(rover);
    }
    void remove() {
        const auto gone = rovers.begin() + random_.integer(0, int(rovers.size()) - 1);
        world_.remove(gone->id);
        rovers.erase(gone);
    }
    void move_to(double now) {
        now_ = now;
        for (const Rover& rover : rovers)
            world_.move(rover.id, rover.at(now));
    }
    /// Turns or moves a body in place, against its bounds.
    void surprise() {
        Rover& rover = rovers[std::size_t(random_.integer(0, int(rovers.size()) - 1))];
        rover.start = rover.at(now_), rover.since = now_;
        rover.bounds = {};
        if (random_.chance(0.5))
            rover.start.rotation = random_.pose(1).rotation;
        else
            rover.start.translation = half_ * random_.in_cube();
        world_.move(rover.id, rover.start);
    }

    std::vector<Rover> rovers;

private:
    Random& random_;
    World& world_;
    double half_, now_ = 0;
    Model ring_;
    Convex solid_;
    Vec3 gravity_{0, 0, -1};
};

bool has(const std::vector<BodyPair>& pairs, const BodyPair& pair) {
    return std::binary_search(pairs.begin(), pairs.end(), pair);
}

TEST(ScheduleEstimates, ReportsAllPairsThatTouchWhereBoxesOverlap) {
    Random random(5311);
    std::size_t met = 0, near = 0;
    std::uint64_t queries = 0;
    for (int round = 0; round < many(20); ++round) {
        set_threads(random.integer(1, 4));
        World world;
        Rovers all(random, world, random.integer(2, 25), 0.8);
        const double dt = random.uniform(0.001, 0.01);
        double now = 0;
        for (int step = 0; step < 150; ++step) {
            const double by = random.chance(0.1) ? 0 : dt;
            all.move_to(now += by);
            if (random.chance(0.05))
                all.surprise();
            const auto touching = world.advance(by);
            ASSERT_EQ(touching, world.collide()) << "round " << round << ", step " << step;
            met += touching.size(), near += world.pairs().size();
            all.turn_back();
            if (random.chance(0.05))
                all.add();
            if (random.chance(0.05) && all.rovers.size() > 2)
                all.remove();
            if (random.chance(0.05)) {
                EXPECT_GE(world.next_event(), 0);
            }
        }
        queries += world.schedule_counters().distance_queries;
    }
    set_threads(0);
    EXPECT_GT(met, 1000U);
    EXPECT_GT(near, 2 * met);
    EXPECT_LT(queries, near);
}

TEST(ScheduleEstimates, NoPairMeetsBeforeItsTimeToCollision) {
    Random random(5312);
    int met = 0, soon = 0, never = 0, apart = 0;
    for (int round = 0; round < many(300); ++round) {
        World world;
        Rovers all(random, world, 2, random.uniform(0.2, 0.8));
        const bool touch = !world.advance(0).empty();
        const Rover &a = all.rovers[0], &b = all.rovers[1];
        const double free = world.time_to_collision(a.id, b.id);
        EXPECT_EQ(free, world.time_to_collision(b.id, a.id));
        if (touch) {
            EXPECT_EQ(free, 0);
            continue;
        }
        ++apart;
        never += free == kInfinity ? 1 : 0;
        // The step is so small that half of the estimate takes several.
        const double dt = std::clamp(free / 20, 1e-3, 0.05);
        for (double t = 0; t < 3; t += dt) {
            all.move_to(t);
            if (world.collide().empty())
                continue;
            EXPECT_LE(free, t) << "round " << round;
            ++met, soon += free > 0.2 * t ? 1 : 0;
            break;
        }
    }
    EXPECT_GT(apart, many(300) / 2);
    EXPECT_GT(met, apart / 8);
    EXPECT_GT(soon, met / 3); // the estimates are worth something
    EXPECT_GT(never, apart / 50);
}

TEST(ScheduleEstimates, OfPrescribedMotionsIsTheFirstContact) {
    Random random(5316);
    constexpr double kStep = 0.004;
    int met = 0;
    for (int round = 0; round < many(200); ++round) {
        World world;
        Rovers all(random, world, 2, random.uniform(0.3, 0.6));
        all.prescribe(all.rovers[0]), all.prescribe(all.rovers[1]);
        if (!world.advance(0).empty())
            continue;
        const double free = world.time_to_collision(all.rovers[0].id, all.rovers[1].id);
        for (double t = 0; t < 0.5; t += kStep) {
            all.move_to(t);
            if (world.collide().empty())
                continue;
            EXPECT_LE(free, t) << "round " << round;
            EXPECT_GE(free, t - kStep - 1e-4) << "round " << round;
            ++met;
            break;
        }
    }
    EXPECT_GT(met, many(200) / 16);
}

TEST(ScheduleEstimates, NothingBeginsToTouchBeforeTheTimeToCollision) {
    Random random(5313);
    int met = 0, long_ones = 0, longer = 0;
    for (int round = 0; round < many(150); ++round) {
        World world;
        Rovers all(random, world, random.integer(3, 10), random.uniform(0.6, 1.6));
        const auto first = world.advance(0);
        const double next = world.next_event();
        const double limit = random.chance(0.5) ? 2 : kInfinity;
        const double free = world.time_to_collision(limit);
        EXPECT_GE(free, next);
        EXPECT_LE(free, limit);
        EXPECT_GE(world.next_event(), next);
        longer += free > next ? 1 : 0;
        long_ones += free > 0.02 ? 1 : 0;
        for (int step = 1; step <= 60; ++step) {
            // The first steps lie before the event, the others after it.
            const double t = step / 20.0 * std::clamp(free, 0.02, 1.0);
            all.move_to(t);
            const auto now = world.collide();
            const bool begun = std::any_of(now.begin(), now.end(),
                                           [&](const BodyPair& pair) { return !has(first, pair); });
            if (begun) {
                EXPECT_LE(free, t) << "round " << round;
                ++met;
                break;
            }
        }
    }
    EXPECT_GT(long_ones, many(150) / 2);
    EXPECT_GT(met, many(150) / 10);
    EXPECT_GT(longer, many(150) / 20);
}

TEST(ScheduleEstimates, AreTheSameForAnyNumberOfThreads) {
    const auto record = [](int threads) {
        set_threads(threads);
        Random random(5314);
        World world;
        Rovers all(random, world, 40, 1.5);
        std::vector<double> numbers;
        for (int step = 0; step < 100; ++step) {
            all.move_to(0.01 * step);
            for (const BodyPair& pair : world.advance(step == 0 ? 0 : 0.01))
                numbers.push_back(pair.a.index), numbers.push_back(pair.b.index);
            numbers.push_back(world.next_event());
            all.turn_back();
        }
        const ScheduleCounters& counters = world.schedule_counters();
        numbers.push_back(double(counters.estimates));
        numbers.push_back(double(counters.distance_queries));
        return numbers;
    };
    const auto one = record(1);
    EXPECT_GT(one.size(), 200U);
    for (const int threads : {2, 3, 4})
        EXPECT_EQ(record(threads), one);
    set_threads(0);
}

TEST(ScheduleEstimates, DeformablesAreTestedAfterEachRefresh) {
    Random random(5315);
    std::size_t met = 0, apart = 0;
    for (int round = 0; round < many(20); ++round) {
        World world;
        Rovers all(random, world, 6, 0.6);
        const Mesh mesh = ring(0.3, 0.06);
        auto cloth = std::make_unique<Deformable>(mesh);
        const BodyId id = world.add(*cloth);
        double now = 0;
        for (int step = 0; step < 60; ++step) {
            if (step % 3 == 0) {
                std::vector<Vec3> to = mesh.positions;
                const Vec3 by = random.in_cube(0.5);
                for (Vec3& p : to)
                    p = p + by + random.in_cube(0.05);
                cloth->set_motion(to, to);
                world.refresh(id);
            }
            all.move_to(now += 0.01);
            const auto touching = world.advance(0.01);
            ASSERT_EQ(touching, world.collide()) << "round " << round << ", step " << step;
            for (const BodyPair& pair : touching)
                met += pair.a == id || pair.b == id ? 1 : 0;
            apart += touching.empty() ? 1 : 0;
            all.turn_back();
        }
    }
    EXPECT_GT(met, 50U);
    EXPECT_GT(apart, 20U);
}

TEST(ScheduleEstimates, UnusualWorldsAndBounds) {
    World world;
    EXPECT_EQ(world.next_event(), kInfinity);
    EXPECT_EQ(world.time_to_collision(), kInfinity);
    EXPECT_EQ(world.time_to_collision(3), 3);
    EXPECT_TRUE(world.advance(1).empty());
    const Model model(ring(0.3, 0.06));
    const BodyId a = world.add(model, Pose{}), b = world.add(model, Pose{}); // they coincide
    EXPECT_EQ(world.time_to_collision(a, b), 0);
    EXPECT_EQ(world.advance(0).size(), 1U);
    EXPECT_THROW(static_cast<void>(world.time_to_collision(a, a)), Error);
    EXPECT_THROW(static_cast<void>(world.time_to_collision(-1)), Error);
    EXPECT_THROW(static_cast<void>(world.time_to_collision(NAN)), Error);
    for (const double bad : {double(NAN), kInfinity}) {
        EXPECT_THROW(world.set_speed(a, {.velocity = {bad, 0, 0}}), Error);
        EXPECT_THROW(world.set_speed(a, {.acceleration = {0, bad, 0}}), Error);
        EXPECT_THROW(world.set_speed(a, {.acceleration_bound = bad}), Error);
        EXPECT_THROW(world.set_speed(a, {.angular_speed = bad}), Error);
        EXPECT_THROW(world.set_speed(a, {.angular_acceleration = bad}), Error);
        EXPECT_THROW(world.set_speed(a, {.angular_velocity = {0, 0, bad}}), Error);
    }
    EXPECT_THROW(world.set_speed(a, {.angular_acceleration = -1}), Error);
    // Bounds near the largest numbers prove nothing, and miss nothing.
    world.set_speed(a, {.velocity = {1e308, -1e308, 0},
                        .acceleration = {-1e308, 0, 1e308},
                        .acceleration_bound = 1e308,
                        .angular_speed = 1e308,
                        .angular_acceleration = 1e308,
                        .angular_velocity = {1e308, 1e308, 0}});
    world.move(b, Pose{{5, 0, 0}, {1, 0, 0, 0}});
    EXPECT_TRUE(world.advance(0.1).empty());
    EXPECT_LT(world.time_to_collision(a, b), 1e-100);
    EXPECT_LT(world.next_event(), 1e-100);
    world.move(b, Pose{});
    EXPECT_EQ(world.advance(0.1).size(), 1U);
    // A body is removed while its pair is scheduled, and another one takes its place.
    world.remove(b);
    EXPECT_TRUE(world.advance(0.1).empty());
    EXPECT_THROW(static_cast<void>(world.time_to_collision(a, b)), Error);
    world.update(), world.update();
    const BodyId c = world.add(Sphere{{}, 0.5}, Pose{});
    EXPECT_EQ(c.index, b.index);
    ASSERT_EQ(world.advance(0.1).size(), 1U);
    EXPECT_EQ(world.advance(0)[0].b, c);
    // At rest, and apart: nothing ever happens.
    world.set_speed(a, {});
    world.move(c, Pose{{2, 0, 0}, {1, 0, 0, 0}});
    EXPECT_TRUE(world.advance(0.1).empty());
    EXPECT_EQ(world.time_to_collision(a, c), kInfinity);
    EXPECT_EQ(world.time_to_collision(), kInfinity);
    // Another speed changes the estimates at once: the gap of 1.14 closes at a speed of 1.
    world.set_speed(c, {.velocity = {-1, 0, 0}});
    EXPECT_NEAR(world.time_to_collision(a, c), 1.14, 0.01);
    EXPECT_NEAR(world.time_to_collision(), 1.14, 0.01);
    EXPECT_NEAR(world.time_to_collision(0.5), 0.5, 1e-12);
    // A static pair never meets.
    world.set_options(a, {.is_static = true});
    world.set_options(c, {.is_static = true});
    EXPECT_EQ(world.time_to_collision(a, c), kInfinity);
}

} // namespace
} // namespace abut::test
