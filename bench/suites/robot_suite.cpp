#include <abut/robot.h>

#include "measure.h"
#include "peers/peer_robot.h"
#include "placement.h"
#include "suite.h"

#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

struct RobotSuiteOptions {
    std::string urdf, srdf;
    std::size_t configurations = 10'000;
    int rounds = 5;
    std::uint64_t seed = 1;
};

/// Random configurations within the limits.
std::vector<double> random_configurations(const Robot& robot, const RobotSuiteOptions& options) {
    scenes::Random random(options.seed);
    std::vector<double> values;
    for (std::size_t i = 0; i < options.configurations; ++i)
        for (const RobotVariable& variable : robot.variables()) {
            const bool is_limited = std::isfinite(variable.limits.lower);
            const double half = variable.is_angle ? std::numbers::pi : 1;
            const double lower = is_limited ? variable.limits.lower : -half;
            const double upper = is_limited ? variable.limits.upper : half;
            values.push_back(lower + unit(random) * (upper - lower));
        }
    return values;
}

class RobotSuite {
public:
    explicit RobotSuite(const RobotSuiteOptions& options)
        : options_(options), robot_(make_robot(options)),
          values_(random_configurations(robot_, options)) {
        report_.suite = "robot";
        report_.notes.push_back(fmt::format("{}: {} tested pairs of links, {} configurations",
                                            robot_.description().name, robot_.pairs().size(),
                                            options.configurations));
        const std::size_t width = robot_.variables().size();
        for (std::size_t i = 0; i < options.configurations; ++i)
            links_.push_back(robot_.link_transforms(std::span(values_).subspan(i * width, width)));
    }

    Report run() && {
        std::vector<bool> meet;
        compare("self collision", make_fcl_robot, &RobotPeer::collide, [&] {
            meet = collide(robot_, Configurations{values_});
            return std::vector<double>(meet.begin(), meet.end());
        });
        compare("self collision", make_bullet_robot, &RobotPeer::collide, [&] {
            meet = collide(robot_, Configurations{values_});
            return std::vector<double>(meet.begin(), meet.end());
        });
        compare("self distance", make_fcl_robot, &RobotPeer::distance, [&] {
            std::vector<double> distances;
            for (const RobotGap& gap : distance(robot_, Configurations{values_}))
                distances.push_back(gap.distance);
            return distances;
        });
        return std::move(report_);
    }

private:
    static Robot make_robot(const RobotSuiteOptions& options) {
        RobotDescription description = read_robot(options.urdf);
        RobotOptions of_robot;
        if (!options.srdf.empty())
            of_robot.allowed = read_srdf(options.srdf, description).allowed;
        return Robot(std::move(description), of_robot);
    }

    template <typename Answer, typename Ours>
    void compare(const std::string& name, std::unique_ptr<RobotPeer> (*make)(const Robot&),
                 Answer (RobotPeer::*theirs)(std::span<const Transform>), const Ours& ours) {
        const std::unique_ptr<RobotPeer> peer = make(robot_);
        std::vector<double> our_answers;
        std::vector<double> their_answers(links_.size());
        std::function<void()> peer_work;
        if (peer)
            peer_work = [&] {
                for (std::size_t i = 0; i < links_.size(); ++i)
                    their_answers[i] = static_cast<double>(((*peer).*theirs)(links_[i]));
            };
        const Turns turns = take_turns(
            options_.rounds, [&] { our_answers = ours(); }, peer_work);
        const double microseconds = 1e6 / static_cast<double>(links_.size());
        Row row{name, turns.ours * microseconds, {}, {}, "us/configuration", 1, {}};
        if (peer) {
            double differ = 0;
            for (std::size_t i = 0; i < links_.size(); ++i)
                differ += std::abs(our_answers[i] - their_answers[i]) > 1e-6 ? 1 : 0;
            row.peer = peer->name();
            row.theirs = turns.theirs * microseconds;
            row.counters["answers more than 1e-6 apart"] = differ;
        }
        report_.rows.push_back(row);
    }

    const RobotSuiteOptions& options_;
    Robot robot_;
    std::vector<double> values_;
    std::vector<std::vector<Transform>> links_;
    Report report_;
};

const Suite kRobotSuite("robot", "A robot's links in many configurations, against FCL and Bullet",
                        [](CLI::App& suite) -> RunSuite {
                            const auto options = std::make_shared<RobotSuiteOptions>();
                            suite.add_option("urdf", options->urdf, "The robot")->required();
                            suite.add_option("--srdf", options->srdf, "Its allowed pairs");
                            suite.add_option("--configurations", options->configurations,
                                             "Number of random configurations");
                            add_rounds(suite, options->rounds);
                            suite.add_option("--seed", options->seed, "Of the configurations");
                            return [options] { return RobotSuite(*options).run(); };
                        });

} // namespace

} // namespace abut::bench
