#include "suites/schedule_rows.h"

#include "measure.h"
#include "suites/moving_scenes.h"

#include <algorithm>
#include <stdexcept>

namespace abut::bench {

namespace {

constexpr int kSteps = 240;
constexpr int kRounds = 3;

/// Means over all steps of a run: rare steps are expensive.
struct RunTimes {
    double advance = 0, all = 0, worst = 0, touching = 0, boxes = 0;
    ScheduleCounters counters;
};

RunTimes run_scene(MovingScene& scene) {
    RunTimes times;
    scene.world.advance(0);
    for (int step = 0; step < kSteps; ++step) {
        scene.move();
        // Each query updates first, so both sides have that time.
        const double before = process_seconds();
        scene.world.update();
        const double update = process_seconds() - before;
        // The second of the two finds the bodies in the cache, so they take turns.
        std::vector<BodyPair> found, all;
        double advance = 0;
        const auto run_advance = [&] {
            const double start = process_seconds();
            found = scene.world.advance(kSceneStep);
            advance = update + process_seconds() - start;
        };
        if (step % 2 == 0)
            run_advance();
        const double start = process_seconds();
        all = scene.world.collide();
        times.all += (update + process_seconds() - start) / kSteps;
        if (step % 2 == 1)
            run_advance();
        if (all != found)
            throw std::logic_error("the schedule has missed a pair");
        times.advance += advance / kSteps;
        times.worst = std::max(times.worst, advance);
        times.touching += static_cast<double>(found.size()) / kSteps;
        times.boxes += static_cast<double>(scene.world.pairs().size()) / kSteps;
        scene.steer();
    }
    times.counters = scene.world.schedule_counters();
    return times;
}

} // namespace

void add_schedule_rows(Report& report, std::uint64_t seed) {
    for (const NamedScene& named : moving_scenes(seed)) {
        std::vector<double> advance, all, worst;
        RunTimes last;
        for (int round = 0; round < kRounds; ++round) {
            last = run_scene(*named.make());
            advance.push_back(last.advance), all.push_back(last.all);
            worst.push_back(last.worst);
        }
        Row row{named.name + ", advance",
                1e3 * median(advance),
                "our own update and touching",
                1e3 * median(all),
                "ms/step",
                1,
                {}};
        const auto steps = static_cast<double>(last.counters.steps);
        row.counters["worst step, ms"] = 1e3 * median(worst);
        row.counters["pairs due a step"] = static_cast<double>(last.counters.estimates) / steps;
        row.counters["of these, measured"] =
            static_cast<double>(last.counters.distance_queries) / steps;
        row.counters["touching a step"] = last.touching;
        row.counters["pairs of boxes a step"] = last.boxes;
        report.rows.push_back(row);
    }
}

} // namespace abut::bench
