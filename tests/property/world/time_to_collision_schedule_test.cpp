// Reports of the collision schedule at each step, against all pairs at that step. Bodies fly,
// bounce, turn, are pushed, come and go.

#include <abut/error.h>
#include <abut/world.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace abut::test {
namespace {

struct Flight {
    Pose pose;
    SpeedBounds bounds;
    double since = 0;
    Vec3 from;
};

/// Bodies of several kinds in a cube, with or without gravity.
class Flights {
public:
    /// surprises: how likely a body is moved at a step without its bounds being told.
    Flights(Random& random, World& world, int count, double gravity, double surprises)
        : random_(random), world_(world), gravity_(gravity), surprises_(surprises),
          model_(Mesh{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}},
                      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}) {
        for (int i = 0; i < count; ++i)
            add();
    }

    void add() {
        const Pose pose = random_.pose(1);
        BodyId id;
        switch (random_.integer(0, 3)) {
        case 0:
            id = world_.add(model_, pose);
            break;
        case 1:
            id = world_.add(Capsule{{{-0.05, 0, 0}, {0.05, 0, 0}}, 0.02}, pose);
            break;
        case 2:
            id = world_.add(Box3{{-0.05, -0.02, -0.03}, {0.05, 0.02, 0.03}}, pose);
            break;
        default:
            id = world_.add(Sphere{{}, random_.chance(0.1) ? 0 : 0.05}, pose);
        }
        Flight& flight = flights_[id];
        flight.pose = pose;
        launch(id, flight, random_.chance(0.1) ? Vec3{} : 0.5 * random_.in_cube());
    }
    void remove() {
        const auto gone = std::next(flights_.begin(), random_.integer(0, int(flights_.size()) - 1));
        world_.remove(gone->first);
        flights_.erase(gone);
    }
    /// Moves all bodies on by dt; some are moved elsewhere unforeseen.
    void step(double dt) {
        now_ += dt;
        for (auto& [id, flight] : flights_) {
            const double t = now_ - flight.since;
            flight.pose.translation =
                flight.from + t * flight.bounds.velocity + (t * t / 2) * flight.bounds.acceleration;
            if (flight.bounds.angular_speed > 0)
                turn(flight.pose, flight.bounds.angular_speed * dt);
            if (random_.chance(surprises_)) {
                flight.pose.translation = random_.in_cube();
                flight.from = flight.pose.translation - t * flight.bounds.velocity -
                              (t * t / 2) * flight.bounds.acceleration;
            }
            world_.move(id, flight.pose);
        }
    }
    /// Changes courses after `advance`: bodies at the walls turn back, and some turn at random.
    void steer() {
        for (auto& [id, flight] : flights_) {
            const double t = now_ - flight.since;
            Vec3 v = flight.bounds.velocity + t * flight.bounds.acceleration;
            const Vec3 p = flight.pose.translation;
            bool turned = random_.chance(0.002);
            if (turned)
                v = 0.5 * random_.in_cube();
            for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z})
                if (std::abs(p.*axis) > 1 && p.*axis * v.*axis > 0)
                    v.*axis = -v.*axis, turned = true;
            if (turned)
                launch(id, flight, v);
            else if (random_.chance(0.2)) // tells the known bounds once more
                tell(id, flight, v);
        }
    }

private:
    void launch(BodyId id, Flight& flight, const Vec3& velocity) {
        flight.bounds.acceleration = {0, 0, -gravity_};
        flight.bounds.angular_speed = random_.chance(0.5) ? 0 : random_.uniform(0, 3);
        tell(id, flight, velocity);
    }
    void tell(BodyId id, Flight& flight, const Vec3& velocity) {
        flight.bounds.velocity = velocity;
        flight.since = now_, flight.from = flight.pose.translation;
        world_.set_speed(id, flight.bounds);
    }
    static void turn(Pose& pose, double angle) {
        auto& [w, x, y, z] = pose.rotation;
        const double c = std::cos(angle / 2), s = std::sin(angle / 2);
        pose.rotation = {c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w};
    }

    Random& random_;
    World& world_;
    double gravity_, surprises_;
    Model model_;
    double now_ = 0;
    std::map<BodyId, Flight> flights_;
};

TEST(CollisionSchedule, ReportsAllPairsThatTouchAtEveryStep) {
    Random random(5301);
    std::size_t met = 0;
    std::uint64_t queries = 0, pairs = 0;
    for (int round = 0; round < many(12); ++round) {
        World world;
        Flights flights(random, world, random.integer(20, 120), round % 2 == 0 ? 0 : 1, 0.001);
        for (int step = 0; step < 150; ++step) {
            const double dt = random.chance(0.1) ? 0 : random.uniform(0.001, 0.02);
            flights.step(dt);
            const auto touching = world.advance(dt);
            ASSERT_EQ(touching, world.collide()) << "step " << step;
            met += touching.size();
            flights.steer();
            if (random.chance(0.05))
                flights.add();
            if (random.chance(0.05))
                flights.remove();
        }
        queries += world.schedule_counters().distance_queries;
        pairs += world.schedule_counters().pairs;
    }
    EXPECT_GT(met, 500U);
    EXPECT_GT(queries, met);
    EXPECT_LT(queries, pairs / 10);
}

TEST(CollisionSchedule, NothingBeginsToTouchBeforeTheNextEvent) {
    Random random(5302);
    int long_ones = 0, short_ones = 0;
    for (int round = 0; round < many(60); ++round) {
        World world;
        Flights flights(random, world, 12, round % 2 == 0 ? 0 : 1, 0);
        std::vector<BodyPair> last = world.advance(0);
        const double until = world.next_event();
        (until > 0.01 ? long_ones : short_ones) += 1;
        double now = 0;
        for (const double dt = until / 20; now + dt <= until; now += dt) {
            flights.step(dt);
            for (const BodyPair& pair : world.collide())
                EXPECT_TRUE(std::binary_search(last.begin(), last.end(), pair));
        }
    }
    EXPECT_GT(long_ones, 10);
}

TEST(CollisionSchedule, TestsDistantBodiesSeldom) {
    World world;
    std::vector<BodyId> ids;
    for (int i = 0; i < 2; ++i) {
        const double x = i == 0 ? -1 : 1;
        ids.push_back(world.add(Sphere{{}, 0.1}, Pose{{x, 0, 0}, {1, 0, 0, 0}}));
        world.set_speed(ids.back(), {{-x, 0, 0}, {}, 0, 0}); // towards each other
    }
    EXPECT_TRUE(world.advance(0).empty());
    // The gap of 1.8 closes at a speed of 2, so in 0.9, unless a horizon comes before that.
    EXPECT_GT(world.next_event(), 0.1);
    EXPECT_LE(world.next_event(), 0.9);
    for (int step = 1; step <= 8; ++step) {
        for (int i = 0; i < 2; ++i)
            world.move(ids[std::size_t(i)],
                       Pose{{(i == 0 ? -1 : 1) * (1 - 0.1 * step), 0, 0}, {1, 0, 0, 0}});
        EXPECT_TRUE(world.advance(0.1).empty());
    }
    EXPECT_LE(world.schedule_counters().distance_queries, 2U);
    for (const BodyId id : ids)
        world.move(id, Pose{});
    EXPECT_EQ(world.advance(0.2).size(), 1U);
    EXPECT_THROW(world.advance(-1), Error);
    EXPECT_THROW(world.set_speed(ids[0], {{NAN, 0, 0}, {}, 0, 0}), Error);
}

} // namespace
} // namespace abut::test
