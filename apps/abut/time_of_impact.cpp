#include <abut/motion.h>

#include "commands.h"
#include "pair_query.h"

#include <fmt/format.h>
#include <memory>
#include <optional>

namespace abut::command {

namespace {

struct ImpactArguments {
    PairQuery pair;
    std::array<std::string, 2> ends; ///< as given; empty: where it starts
    bool screw = false;
    std::optional<double> tolerance;
};

Motion motion_of(const ImpactArguments& arguments, std::size_t side) {
    constexpr std::array kPoses{"--pose-a", "--pose-b"}, kEnds{"--end-a", "--end-b"};
    const std::string &start = arguments.pair.models.poses.at(side), &end = arguments.ends.at(side);
    const Pose from = start.empty() ? Pose{} : parse_pose(kPoses.at(side), start);
    if (end.empty())
        return Motion::fixed(from);
    const Pose to = parse_pose(kEnds.at(side), end);
    return arguments.screw ? Motion::screw(from, to) : Motion::between(from, to);
}

struct ImpactQuery : PairQuery {
    Motion motion_a, motion_b;
    std::optional<double> tolerance;

    [[nodiscard]] Impact ask(const TwoModels& m) const {
        return time_of_impact(m.a, motion_a, m.b, motion_b, {.tolerance = tolerance});
    }
    static void add_answer(const Impact& impact, nlohmann::ordered_json& json) {
        json["hit"] = impact.hit;
        json["time"] = impact.time;
        json["status"] = to_string(impact.status);
        if (impact.hit) {
            json["contact_time"] = impact.status == Status::exact
                                       ? nlohmann::ordered_json(impact.contact_time)
                                       : nlohmann::ordered_json();
            json["gap"] = impact.gap;
            json["point_a"] = to_json(impact.point_a);
            json["point_b"] = to_json(impact.point_b);
            json["normal"] = to_json(impact.normal);
            json["triangle_a"] = impact.triangle_a;
            json["triangle_b"] = impact.triangle_b;
        }
        json["counters"] = describe(impact.counters);
    }
    static std::string in_words(const Impact& impact) {
        if (!impact.hit)
            return "no impact\n";
        return fmt::format(
            "impact at {}{}, gap {}\n"
            "point on A ({}, {}, {}), triangle {}\n"
            "point on B ({}, {}, {}), triangle {}\n",
            impact.time, impact.status == Status::exact ? "" : " (near; contact not decided)",
            impact.gap, impact.point_a.x, impact.point_a.y, impact.point_a.z, impact.triangle_a,
            impact.point_b.x, impact.point_b.y, impact.point_b.z, impact.triangle_b);
    }
    static bool is_problem(const Impact& impact) { return impact.hit; }
};

/// Checks the poses.
ImpactQuery query_of(const ImpactArguments& arguments) {
    return {arguments.pair, motion_of(arguments, 0), motion_of(arguments, 1), arguments.tolerance};
}

} // namespace

Subcommand add_time_of_impact(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<ImpactArguments>();
    CLI::App* app =
        add_subcommand(root, common, "time-of-impact",
                       "When do two moving models first meet, from time 0 (their poses) to 1?");
    add_two_models(*app, arguments->pair.models);
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
    add_fail_on(*app, arguments->pair.fail_on, "impact");
    return {app, [arguments, &common] { return run(query_of(*arguments), common); }};
}

} // namespace abut::command
