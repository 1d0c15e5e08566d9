#include <abut/robot.h>

#include "articulated/placed_bodies.h"
#include "core/arguments.h"
#include "core/parallel.h"
#include "core/progress.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace abut {

namespace {

using LinkPair = std::pair<std::uint32_t, std::uint32_t>;

/// Random numbers for one configuration, whatever the order in which configurations are made.
/// Source      SplitMix64 [Steele, Lea, Flood 2014].
class ConfigurationRandom {
public:
    ConfigurationRandom(std::uint64_t seed, std::uint64_t index)
        : state_(mixed(seed) ^ mixed(index + 0x632be59bd9b4e019)) {}

    double between(double low, double high) {
        state_ += kGolden;
        const double unit = static_cast<double>(mixed(state_) >> 11) * 0x1p-53;
        return low + unit * (high - low);
    }

private:
    static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;
    static std::uint64_t mixed(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    std::uint64_t state_;
};

std::vector<double> random_configuration(const Robot& robot, std::uint64_t seed,
                                         std::uint64_t index) {
    constexpr double kSlide = 1; // metres to either side, without limits
    ConfigurationRandom random(seed, index);
    std::vector<double> values;
    for (const RobotVariable& variable : robot.variables()) {
        const double half = variable.is_angle ? std::numbers::pi : kSlide;
        // A limit beyond the values that queries accept is none.
        const auto& [lower, upper] = variable.limits;
        const bool has_lower = lower >= -kLargestValue;
        const bool has_upper = upper <= kLargestValue;
        const double low = has_lower ? lower : has_upper ? std::min(-half, upper - half) : -half;
        const double high = has_upper ? upper : has_lower ? std::max(half, lower + half) : half;
        values.push_back(random.between(low, high));
    }
    return values;
}

/// How often each tested pair meets. The counts are in the order of Robot::pairs().
class MeetingCounts {
public:
    explicit MeetingCounts(const Robot& robot)
        : robot_(robot), bodies_(robot.data(), {}), counts_(robot.pairs().size()) {}

    void add(std::span<const double> configuration, PlacedBodies& placed) {
        placed.place(configuration);
        // Tests are sorted by pairs, so one walk over both finds the pair of each test.
        std::size_t pair = 0;
        bool is_counted = false;
        for (const BodyTest& test : bodies_.tests()) {
            const LinkPair links{bodies_[test.a].owner, bodies_[test.b].owner};
            while (robot_.pairs()[pair] != links)
                ++pair, is_counted = false;
            if (!is_counted && placed.ball_gap(test) <= 0 && placed.meet(test)) {
                is_counted = true;
                counts_[pair].fetch_add(1, std::memory_order_relaxed);
            }
        }
    }
    [[nodiscard]] const QueryBodies& bodies() const { return bodies_; }
    [[nodiscard]] std::uint64_t of(std::size_t pair) const { return counts_[pair].load(); }

private:
    const Robot& robot_;
    QueryBodies bodies_;
    std::vector<std::atomic<std::uint64_t>> counts_;
};

/// The pairs that only their adjacency leaves out.
std::vector<AllowedPair> adjacent_pairs(const RobotData& robot) {
    RobotDescription bare = robot.description;
    for (RobotLink& link : bare.links)
        for (RobotShape& shape : link.shapes)
            if (!shape.mesh.triangles.empty())
                shape.mesh = {{{}}, {{0, 0, 0}}}; // a point: hierarchies cost nothing
    const Robot all(std::move(bare), {.allowed = robot.allowed, .allow_adjacent = false});
    std::vector<AllowedPair> adjacent;
    for (const auto& [a, b] : all.pairs())
        if (!std::ranges::binary_search(robot.pairs, LinkPair{a, b}))
            adjacent.push_back({a, b, AllowReason::adjacent});
    return adjacent;
}

} // namespace

std::vector<AllowedPair> propose_allowed_pairs(const Robot& robot,
                                               const AllowedPairsOptions& options) {
    require(options.samples > 0, "the number of samples must be positive");
    constexpr std::uint64_t kChunk = 64;
    const StopScope stopping(options.progress);
    const std::uint64_t chunks = (options.samples - 1) / kChunk + 1;
    ProgressMeter meter(options.progress, "configurations", options.samples);
    MeetingCounts counts(robot);
    parallel_for(chunks, 1, [&](std::size_t chunk) {
        PlacedBodies placed(counts.bodies());
        const std::uint64_t begin = chunk * kChunk;
        const std::uint64_t end = begin + std::min(kChunk, options.samples - begin);
        for (std::uint64_t i = begin; i < end; ++i) {
            poll_stop();
            const std::vector<double> configuration = random_configuration(robot, options.seed, i);
            robot.data().require_valid(configuration);
            counts.add(configuration, placed);
        }
        meter.advance(end - begin);
    });
    std::vector<AllowedPair> allowed = adjacent_pairs(robot.data());
    const std::vector<RobotPair> at_rest = collide(robot, robot.default_configuration());
    for (std::size_t i = 0; i < robot.pairs().size(); ++i) {
        const auto& [a, b] = robot.pairs()[i];
        const std::uint64_t meetings = counts.of(i);
        if (std::ranges::find(at_rest, RobotPair{a, b, false}) != at_rest.end())
            allowed.push_back({a, b, AllowReason::at_rest});
        else if (meetings == options.samples)
            allowed.push_back({a, b, AllowReason::always});
        else if (meetings == 0)
            allowed.push_back({a, b, AllowReason::never});
    }
    std::ranges::sort(allowed, {}, [](const AllowedPair& pair) {
        return LinkPair{pair.a, pair.b};
    });
    return allowed;
}

} // namespace abut
