#include <abut/motion.h>

#include "commands.h"
#include "pair/pair_query.h"

#include <fmt/format.h>
#include <memory>
#include <optional>

namespace abut::command {

namespace {

struct ImpactArguments {
    PairQuery pair;
    std::array<std::string, 2> ends; ///< as given; the start pose if empty
    bool screw = false;
    std::optional<double> tolerance;
    std::optional<std::uint64_t> max_steps;
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
    std::optional<std::uint64_t> max_steps;
    ProgressBar::Style progress_style = ProgressBar::Style::none;

    [[nodiscard]] Impact ask(const TwoModels& m) const {
        ProgressBar bar(progress_style);
        return time_of_impact(
            m.a, motion_a, m.b, motion_b,
            {.absolute_error = tolerance, .max_steps = max_steps, .progress = bar.progress()});
    }
    static void add_answer(const Impact& impact, nlohmann::ordered_json& json) {
        json["meet"] = impact.meet;
        json["hit"] = impact.meet; // the name before 0.1, kept for scripts
        json["time"] = impact.time;
        json["status"] = to_string(impact.status);
        json["out_of_steps"] = impact.out_of_steps;
        json["steps"] = impact.steps;
        if (impact.meet && !impact.out_of_steps) {
            json["contact_time"] = impact.status == Status::bound_only
                                       ? nlohmann::ordered_json()
                                       : nlohmann::ordered_json(impact.contact_time);
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
        if (!impact.meet)
            return "no impact\n";
        if (impact.out_of_steps)
            return fmt::format("free up to {}; not decided after that: {} steps were not enough\n",
                               number_below(impact.time), grouped(impact.steps));
        return fmt::format("impact at {}{}, gap {}\n"
                           "point on A {}, triangle {}\n"
                           "point on B {}, triangle {}\n",
                           number_below(impact.time),
                           impact.status == Status::bound_only ? " (near; contact not decided)"
                                                               : "",
                           metres(impact.gap), point(impact.point_a), impact.triangle_a,
                           point(impact.point_b), impact.triangle_b);
    }
    static bool is_problem(const Impact& impact) { return impact.meet; }
};

/// Checks the poses and returns the query.
ImpactQuery query_of(const ImpactArguments& arguments, const CommonOptions& common) {
    return {arguments.pair,      motion_of(arguments, 0), motion_of(arguments, 1),
            arguments.tolerance, arguments.max_steps,     common.progress_style()};
}

} // namespace

Subcommand add_time_of_impact(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<ImpactArguments>();
    CLI::App* app = add_subcommand(
        root, common,
        {"time-of-impact",
         kTwoModels,
         "When do two moving models first meet between time 0 (their poses) and time 1?",
         {{"abut time-of-impact a.obj b.stl --pose-b 3,0,0,1,0,0,0 --end-b -3,0,0,0,0,0,1",
           "B moves by six metres and makes half a turn"},
          {"abut time-of-impact a.obj b.stl --pose-b 3,0,0,1,0,0,0 --end-b 0,0,0,1,0,0,0 "
           "--absolute-error 1mm --fail-on impact",
           "faster, with a time up to a millimetre before the contact; exit status 1 on impact"}},
         "the models meet (with --fail-on impact)"});
    add_two_models(*app, arguments->pair.models);
    app->add_option("--end-a", arguments->ends[0], "Pose of A at time 1 (default: A does not move)")
        ->check(not_empty("POSE"));
    app->add_option("--end-b", arguments->ends[1], "Pose of B at time 1 (default: B does not move)")
        ->check(not_empty("POSE"));
    app->add_flag("--screw", arguments->screw,
                  "Move along screws; otherwise the models' origins move along straight lines");
    add_length(*app, "--absolute-error,--tolerance", arguments->tolerance,
               "Largest distance left at the returned time (default: a millionth of the larger "
               "model's diagonal)");
    app->add_option("--max-steps", arguments->max_steps,
                    "End the search after N steps (pairs of boxes or of triangles) and print what "
                    "is proven so far (default: no limit)")
        ->type_name("N")
        ->check(not_negative());
    add_fail_on(*app, arguments->pair.fail_on, "impact");
    return {app, [arguments, &common] { return run(query_of(*arguments, common), common); }};
}

} // namespace abut::command
