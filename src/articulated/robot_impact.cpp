#include <abut/robot.h>

#include "articulated/placed_bodies.h"
#include "articulated/relative_speed.h"
#include "core/arguments.h"
#include "core/stop.h"

#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

namespace abut {

namespace {

/// A pair of bodies that is free up to a time.
struct FreePair {
    double time = 0;
    std::uint32_t test = 0;
    /// The earliest comes first.
    friend bool operator<(const FreePair& a, const FreePair& b) {
        return std::tie(b.time, b.test) < std::tie(a.time, a.test);
    }
};

class ConservativeAdvancement {
public:
    ConservativeAdvancement(const Robot& robot, std::span<const double> from,
                            std::span<const double> to, const RobotImpactOptions& options)
        : from_(from), to_(to), options_(options), bodies_(robot.data(), options), placed_(bodies_),
          speeds_(robot.data(), from, to) {}

    RobotImpact run() {
        for (std::uint32_t i = 0; i < bodies_.tests().size(); ++i)
            free_.push({0, i});
        while (!free_.empty() && !impact_.meet) {
            poll_stop();
            const FreePair next = free_.top();
            free_.pop();
            if (++impact_.steps > options_.max_steps)
                return undecided(next, std::numeric_limits<double>::infinity());
            step(next);
        }
        return impact_;
    }

private:
    void place(double time) {
        if (time == placed_at_)
            return;
        placed_at_ = time;
        configuration_.resize(from_.size());
        for (std::size_t i = 0; i < from_.size(); ++i)
            configuration_[i] = time >= 1 ? to_[i] : from_[i] + time * (to_[i] - from_[i]);
        placed_.place(configuration_);
    }

    /// Measures a pair at the time up to which it is free, and advances it or ends the search.
    void step(const FreePair& pair) {
        const BodyTest& test = bodies_.tests()[pair.test];
        const double speed = speeds_.bound(bodies_, test);
        const double way = speed * (1 - pair.time);
        place(pair.time);
        const double ball_gap = placed_.ball_gap(test) - speeds_.rounding();
        if (ball_gap > way)
            return;
        // Balls suffice as long as they are far apart.
        if (ball_gap > std::min(bodies_[test.a].radius, bodies_[test.b].radius))
            return advance(pair, ball_gap, speed);
        const double hull_gap = placed_.hull_gap(test) - speeds_.rounding();
        if (hull_gap > way)
            return;
        if (hull_gap > kFar * options_.absolute_error)
            return advance(pair, hull_gap, speed);
        const double bound = way + 2 * speeds_.rounding() + options_.absolute_error;
        const Gap gap =
            placed_.measure(test, {.upper_bound = bound, .relative_error = kRelativeError});
        if (gap.distance == 0)
            return found(pair, pair.time, 0);
        if (pair.time >= 1 || speed == 0)
            return;
        const double least = gap.at_least - speeds_.rounding();
        if (least > way)
            return;
        if (gap.distance <= options_.absolute_error || pair.time + least / speed <= pair.time)
            return near(pair, gap.distance, speed);
        advance(pair, least, speed);
    }

    void advance(const FreePair& pair, double gap, double speed) {
        free_.push({std::min(1.0, pair.time + gap / speed), pair.test});
    }

    /// Looks for a contact soon after a time at which the pair is near.
    void near(const FreePair& pair, double gap, double speed) {
        const double first = std::max(options_.absolute_error, gap) / speed;
        double later = first;
        for (int i = 0; i < kProbes && pair.time + later < 1; ++i, later *= 2) {
            place(pair.time + later);
            if (placed_.meet(bodies_.tests()[pair.test]))
                return found(pair, pair.time + later, gap);
        }
        undecided(pair, gap);
    }

    RobotImpact undecided(const FreePair& pair, double gap) {
        found(pair, std::numeric_limits<double>::infinity(), gap);
        impact_.status = Status::bound_only;
        return impact_;
    }

    void found(const FreePair& pair, double contact_time, double gap) {
        impact_.meet = true;
        impact_.time = pair.time;
        impact_.contact_time = contact_time;
        impact_.pair = bodies_.pair_of(bodies_.tests()[pair.test]);
        impact_.gap = gap;
    }

    /// From this many times the error on, hulls suffice.
    static constexpr double kFar = 16;
    /// How much more than the true distance a measured one may be, which makes measuring cheaper.
    static constexpr double kRelativeError = 0.25;
    /// Places after a near approach at which a contact is looked for, each twice as far as the one
    /// before.
    static constexpr int kProbes = 12;

    std::span<const double> from_, to_;
    const RobotImpactOptions& options_;
    QueryBodies bodies_;
    PlacedBodies placed_;
    RelativeSpeed speeds_;
    std::priority_queue<FreePair> free_;
    std::vector<double> configuration_;
    double placed_at_ = -1;
    RobotImpact impact_;
};

} // namespace

RobotImpact time_of_impact(const Robot& robot, std::span<const double> from,
                           std::span<const double> to, const RobotImpactOptions& options) {
    robot.data().require_valid(from);
    robot.data().require_valid(to);
    require(options.absolute_error > 0 && std::isfinite(options.absolute_error),
            "the absolute error must be positive");
    const StopScope stopping(options.progress);
    return ConservativeAdvancement(robot, from, to, options).run();
}

} // namespace abut
