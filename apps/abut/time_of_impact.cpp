#include <abut/motion.h>

#include "commands.h"
#include "two_models.h"

#include <fmt/format.h>
#include <memory>
#include <optional>

namespace abut::command {

namespace {

struct ImpactArguments {
    TwoModelsOptions models;
    std::array<std::string, 2> ends; ///< as given; empty: where it starts
    bool screw = false;
    std::optional<double> tolerance;
    std::string fail_on;
};

Motion motion_of(const ImpactArguments& arguments, std::size_t side) {
    constexpr std::array kPoses{"--pose-a", "--pose-b"}, kEnds{"--end-a", "--end-b"};
    const std::string &start = arguments.models.poses.at(side), &end = arguments.ends.at(side);
    const Pose from = start.empty() ? Pose{} : parse_pose(kPoses.at(side), start);
    if (end.empty())
        return Motion::fixed(from);
    const Pose to = parse_pose(kEnds.at(side), end);
    return arguments.screw ? Motion::screw(from, to) : Motion::between(from, to);
}

nlohmann::ordered_json answer_of(const ImpactArguments& arguments, const Impact& impact) {
    nlohmann::ordered_json answer = describe(arguments.models);
    answer["hit"] = impact.hit;
    answer["time"] = impact.time;
    answer["status"] = to_string(impact.status);
    if (impact.hit) {
        answer["contact_time"] = impact.status == Status::exact
                                     ? nlohmann::ordered_json(impact.contact_time)
                                     : nlohmann::ordered_json();
        answer["gap"] = impact.gap;
        answer["point_a"] = to_json(impact.point_a);
        answer["point_b"] = to_json(impact.point_b);
        answer["normal"] = to_json(impact.normal);
        answer["triangle_a"] = impact.triangle_a;
        answer["triangle_b"] = impact.triangle_b;
    }
    answer["counters"] = describe(impact.counters);
    return answer;
}

int run(const ImpactArguments& arguments, const CommonOptions& common) {
    const Motion motion_a = motion_of(arguments, 0), motion_b = motion_of(arguments, 1);
    const TwoModels models = load(arguments.models, common);
    const Stopwatch watch;
    const Impact impact =
        time_of_impact(models.a, motion_a, models.b, motion_b, {.tolerance = arguments.tolerance});
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json answer = answer_of(arguments, impact);
        answer["seconds"] = describe_seconds(models, seconds);
        print(dump(answer));
    } else if (!common.quiet) {
        std::string text = "no impact\n";
        if (impact.hit)
            text = fmt::format(
                "impact at {}{}, gap {}\n"
                "point on A ({}, {}, {}), triangle {}\n"
                "point on B ({}, {}, {}), triangle {}\n",
                impact.time, impact.status == Status::exact ? "" : " (near; contact not decided)",
                impact.gap, impact.point_a.x, impact.point_a.y, impact.point_a.z, impact.triangle_a,
                impact.point_b.x, impact.point_b.y, impact.point_b.z, impact.triangle_b);
        print(text);
    }
    return impact.hit && !arguments.fail_on.empty() ? kExitProblem : kExitDone;
}

} // namespace

Subcommand add_time_of_impact(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<ImpactArguments>();
    CLI::App* app =
        add_subcommand(root, common, "time-of-impact",
                       "When do two moving models first meet, from time 0 (their poses) to 1?");
    add_two_models(*app, arguments->models);
    app->add_option("--end-a", arguments->ends[0], "Pose of A at time 1 (default: A stands still)")
        ->check(not_empty("POSE"));
    app->add_option("--end-b", arguments->ends[1], "Pose of B at time 1 (default: B stands still)")
        ->check(not_empty("POSE"));
    app->add_flag("--screw", arguments->screw,
                  "Move along screws, not the models' origins along straight lines");
    app->add_option("--tolerance", arguments->tolerance,
                    "Distance in metres that may be left at the time returned (default: a "
                    "millionth of the larger model's diagonal)")
        ->check(not_negative());
    app->add_option("--fail-on", arguments->fail_on, "Exit with status 1 on 'impact'")
        ->check(CLI::IsMember({"impact"}));
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
