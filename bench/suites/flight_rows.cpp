#include "suites/flight_rows.h"

#include <abut/world.h>

#include "measure.h"

#include <cmath>
#include <fmt/format.h>
#include <random>
#include <stdexcept>

namespace abut::bench {

namespace {

constexpr double kStep = 1.0 / 240;
constexpr int kSteps = 480;
constexpr double kGravity = 9.81;

/// Balls, capsules and bricks about 0.2 across, in a box with a cubic metre for each.
class Flights {
public:
    Flights(int count, std::uint64_t seed)
        : random_(seed), half_(0.5 * std::cbrt(static_cast<double>(count))) {
        for (int i = 0; i < count; ++i) {
            const Vec3 p = draw(half_), v = draw(3);
            const Pose pose{p, {1, draw(1).x, draw(1).y, draw(1).z}};
            BodyId id;
            if (i % 3 == 0)
                id = world.add(Sphere{{}, 0.1}, pose);
            else if (i % 3 == 1)
                id = world.add(Capsule{{{-0.1, 0, 0}, {0.1, 0, 0}}, 0.05}, pose);
            else
                id = world.add(Box3{{-0.1, -0.06, -0.04}, {0.1, 0.06, 0.04}}, pose);
            bodies_.push_back({id, pose, v});
            tell(bodies_.back());
        }
        world.advance(0);
    }

    void move() {
        for (Flight& flight : bodies_) {
            Vec3& p = flight.pose.translation;
            p.x += kStep * flight.velocity.x, p.y += kStep * flight.velocity.y;
            p.z += kStep * flight.velocity.z - 0.5 * kGravity * kStep * kStep;
            flight.velocity.z -= kGravity * kStep;
            world.move(flight.id, flight.pose);
        }
    }
    void bounce() {
        for (Flight& flight : bodies_) {
            bool turned = false;
            for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
                double& v = flight.velocity.*axis;
                const double p = flight.pose.translation.*axis;
                if (std::abs(p) > half_ && p * v > 0)
                    v = -v, turned = true;
            }
            if (turned)
                tell(flight);
        }
    }

    World world;

private:
    struct Flight {
        BodyId id;
        Pose pose;
        Vec3 velocity;
    };
    void tell(const Flight& flight) {
        world.set_speed(flight.id, {flight.velocity, {0, 0, -kGravity}, 0, 0});
    }
    Vec3 draw(double half) {
        std::uniform_real_distribution<double> along(-half, half);
        const double x = along(random_), y = along(random_), z = along(random_);
        return {x, y, z};
    }

    std::mt19937_64 random_;
    double half_;
    std::vector<Flight> bodies_;
};

} // namespace

void add_flight_rows(Report& report, int bodies, std::uint64_t seed) {
    Flights flights(bodies, seed);
    std::vector<double> advance, all;
    std::size_t touching = 0;
    for (int step = 0; step < kSteps; ++step) {
        flights.move();
        // The second of the two finds the bodies in the cache, so they take turns.
        std::vector<BodyPair> found, touching_now;
        const auto time_of = [](const auto& query) {
            const double start = process_seconds();
            query();
            return process_seconds() - start;
        };
        const auto run_advance = [&] {
            advance.push_back(time_of([&] { found = flights.world.advance(kStep); }));
        };
        if (step % 2 == 0)
            run_advance();
        all.push_back(time_of([&] { touching_now = flights.world.collide(); }));
        if (step % 2 == 1)
            run_advance();
        if (touching_now != found)
            throw std::logic_error("the schedule has missed a pair");
        touching += found.size();
        flights.bounce();
    }
    const ScheduleCounters& counters = flights.world.schedule_counters();
    Row row{fmt::format("{} bodies in flight, advance", bodies),
            1e3 * median(advance),
            "our own update and touching",
            1e3 * median(all),
            "ms/step",
            1,
            {}};
    const auto queries = static_cast<double>(counters.distance_queries),
               pairs = static_cast<double>(counters.pairs);
    row.counters["distance queries a step"] = queries / static_cast<double>(counters.steps);
    row.counters["pairs a query"] = pairs / queries;
    row.counters["touching a step"] = static_cast<double>(touching) / kSteps;
    report.rows.push_back(row);
}

} // namespace abut::bench
