#include <abut/error.h>
#include <abut/robot.h>

#include "articulated/placed_bodies.h"
#include "core/arguments.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/stop.h"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace abut {

namespace {

/// A test with a lower bound of its distance.
struct BoundedTest {
    double bound = 0;
    std::uint32_t test = 0;
    bool by_hulls = false; ///< the bound is that of the hulls, else that of the balls
    /// The nearest comes first in a heap.
    friend bool operator<(const BoundedTest& a, const BoundedTest& b) {
        return std::tie(b.bound, b.test) < std::tie(a.bound, a.test);
    }
};

/// The scratch memory of one thread's queries.
struct QueryScratch {
    explicit QueryScratch(const QueryBodies& bodies) : placed(bodies) {}
    PlacedBodies placed;
    std::vector<BoundedTest> heap;
};

/// Fills the heap with the tests whose balls are nearer than a distance.
void find_near(const QueryBodies& bodies, double distance, QueryScratch& scratch) {
    scratch.heap.clear();
    for (std::uint32_t i = 0; i < bodies.tests().size(); ++i)
        if (const double gap = scratch.placed.ball_gap(bodies.tests()[i]); gap < distance)
            scratch.heap.push_back({gap, i, false});
    std::make_heap(scratch.heap.begin(), scratch.heap.end());
}

/// The nearest test first: by balls, then by hulls, then by triangles. A search ends when no bound
/// is below the distance found.
RobotGap nearest_pair(const QueryBodies& bodies, std::span<const double> configuration,
                      double upper_bound, QueryScratch& scratch) {
    scratch.placed.place(configuration);
    find_near(bodies, upper_bound, scratch);
    std::vector<BoundedTest>& heap = scratch.heap;
    RobotGap best;
    best.distance = upper_bound;
    best.status = Status::bound_only;
    while (!heap.empty() && heap.front().bound < best.distance) {
        std::pop_heap(heap.begin(), heap.end());
        BoundedTest& next = heap.back();
        const BodyTest& test = bodies.tests()[next.test];
        if (!next.by_hulls) {
            next.bound = std::max(next.bound, scratch.placed.hull_gap(test));
            next.by_hulls = true;
            std::push_heap(heap.begin(), heap.end());
            continue;
        }
        heap.pop_back();
        const Gap gap = scratch.placed.measure(test, {.upper_bound = best.distance});
        if (gap.distance < best.distance)
            best = {gap.distance, bodies.pair_of(test), gap.point_a, gap.point_b, gap.status};
        if (best.distance == 0)
            break;
    }
    if (best.status == Status::bound_only)
        best.distance = std::numeric_limits<double>::infinity();
    return best;
}

bool meets(const QueryBodies& bodies, std::span<const double> configuration,
           QueryScratch& scratch) {
    scratch.placed.place(configuration);
    find_near(bodies, std::numeric_limits<double>::min(), scratch);
    // The pair that is nearest by its balls is the likeliest to meet.
    std::sort_heap(scratch.heap.begin(), scratch.heap.end());
    return std::any_of(scratch.heap.rbegin(), scratch.heap.rend(), [&](const BoundedTest& next) {
        return scratch.placed.meet(bodies.tests()[next.test]);
    });
}

/// Calls query(i, configuration, scratch) for each configuration, in parallel.
template <typename Query>
void for_each_configuration(const Robot& robot, const QueryBodies& bodies,
                            std::span<const double> values, const Progress& progress,
                            const Query& query) {
    const std::size_t width = robot.variables().size();
    require(width == 0 ? values.empty() : values.size() % width == 0,
            "the configurations have " + std::to_string(values.size()) +
                " values, which is not a multiple of the robot's " + std::to_string(width) +
                " variables");
    const std::size_t count = width == 0 ? 0 : values.size() / width;
    for (std::size_t i = 0; i < count; ++i)
        try {
            robot.data().require_valid(values.subspan(i * width, width));
        } catch (const Error& error) {
            throw Error(error.code(), "configuration " + std::to_string(i) + ": " + error.what());
        }
    constexpr std::size_t kChunk = 32;
    const StopScope stopping(progress);
    ProgressMeter meter(progress, "configurations", count);
    parallel_for((count + kChunk - 1) / kChunk, 1, [&](std::size_t chunk) {
        QueryScratch scratch(bodies);
        const std::size_t end = std::min(count, (chunk + 1) * kChunk);
        for (std::size_t i = chunk * kChunk; i < end; ++i)
            query(i, values.subspan(i * width, width), scratch);
        meter.advance(end - chunk * kChunk);
    });
}

void require_bound(double upper_bound) {
    require_not_negative(upper_bound, "the upper bound");
}

} // namespace

std::vector<RobotPair> collide(const Robot& robot, std::span<const double> configuration,
                               const RobotQuery& query) {
    robot.data().require_valid(configuration);
    const StopScope stopping(query.progress);
    const QueryBodies bodies(robot.data(), query);
    PlacedBodies placed(bodies);
    placed.place(configuration);
    std::vector<RobotPair> pairs;
    for (const BodyTest& test : bodies.tests()) {
        poll_stop();
        const RobotPair pair = bodies.pair_of(test);
        if (std::ranges::find(pairs, pair) == pairs.end() && placed.ball_gap(test) <= 0 &&
            placed.meet(test))
            pairs.push_back(pair);
    }
    std::ranges::sort(pairs, {}, [](const RobotPair& pair) {
        return std::tuple(pair.is_obstacle, pair.link, pair.other);
    });
    return pairs;
}

RobotGap distance(const Robot& robot, std::span<const double> configuration,
                  const RobotDistanceOptions& options) {
    robot.data().require_valid(configuration);
    require_bound(options.upper_bound);
    const StopScope stopping(options.progress);
    const QueryBodies bodies(robot.data(), options);
    QueryScratch scratch(bodies);
    return nearest_pair(bodies, configuration, options.upper_bound, scratch);
}

std::vector<RobotGap> distance(const Robot& robot, Configurations configurations,
                               const RobotDistanceOptions& options) {
    require_bound(options.upper_bound);
    const QueryBodies bodies(robot.data(), options);
    std::vector<RobotGap> gaps(
        robot.variables().empty() ? 0 : configurations.values.size() / robot.variables().size());
    for_each_configuration(robot, bodies, configurations.values, options.progress,
                           [&](std::size_t i, std::span<const double> q, QueryScratch& scratch) {
                               gaps[i] = nearest_pair(bodies, q, options.upper_bound, scratch);
                           });
    return gaps;
}

std::vector<bool> collide(const Robot& robot, Configurations configurations,
                          const RobotQuery& query) {
    const QueryBodies bodies(robot.data(), query);
    // Bits of a vector<bool> share bytes, so each thread first writes a byte of its own.
    std::vector<std::uint8_t> answers(
        robot.variables().empty() ? 0 : configurations.values.size() / robot.variables().size());
    for_each_configuration(robot, bodies, configurations.values, query.progress,
                           [&](std::size_t i, std::span<const double> q, QueryScratch& scratch) {
                               answers[i] = meets(bodies, q, scratch) ? 1 : 0;
                           });
    return {answers.begin(), answers.end()};
}

} // namespace abut
