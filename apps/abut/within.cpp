#include "commands.h"
#include "two_models.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct WithinArguments {
    TwoModelsOptions models;
    PosesOption poses;
    double tolerance = 0;
    std::string fail_on;
};

int run_many(const WithinArguments& arguments, const CommonOptions& common) {
    const std::vector<Pose> poses = read_poses(arguments.poses.file);
    const TwoModels models = load(arguments.models, common);
    const Stopwatch watch;
    const std::vector<bool> near =
        within(models.a, models.b, placements(models, poses), arguments.tolerance);
    const double seconds = watch.seconds();
    if (common.json) {
        nlohmann::ordered_json answer = describe(arguments.models);
        answer["tolerance"] = arguments.tolerance;
        answer["poses"] = nlohmann::ordered_json::array();
        for (const bool each : near)
            answer["poses"].push_back({{"within", each}});
        answer["seconds"] = describe_seconds(models, seconds);
        print(dump(answer));
    } else if (!common.quiet) {
        std::string text;
        for (const bool each : near)
            text += each ? "within\n" : "farther\n";
        print(text);
    }
    const bool any = std::find(near.begin(), near.end(), true) != near.end();
    return any && !arguments.fail_on.empty() ? kExitProblem : kExitDone;
}

int run(const WithinArguments& arguments, const CommonOptions& common) {
    const TwoModels models = load(arguments.models, common);
    const Stopwatch watch;
    const bool near =
        within(models.a, models.world_from_a, models.b, models.world_from_b, arguments.tolerance);
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json answer = describe(arguments.models);
        answer["tolerance"] = arguments.tolerance;
        answer["within"] = near;
        answer["seconds"] = describe_seconds(models, seconds);
        print(dump(answer));
    } else if (!common.quiet) {
        print(fmt::format("{} {}\n", near ? "within" : "farther than", arguments.tolerance));
    }
    return near && !arguments.fail_on.empty() ? kExitProblem : kExitDone;
}

} // namespace

Subcommand add_within(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<WithinArguments>();
    CLI::App* app = add_subcommand(root, common, "within",
                                   "Are two models at most a tolerance apart, or in contact?");
    add_two_models(*app, arguments->models);
    add_poses(*app, arguments->poses);
    add_volume(*app, arguments->models);
    app->add_option("--tolerance", arguments->tolerance, "Distance in metres")
        ->required()
        ->check(not_negative());
    app->add_option("--fail-on", arguments->fail_on, "Exit with status 1 on 'within'")
        ->check(CLI::IsMember({"within"}));
    return {app, [arguments, &common] {
                return arguments->poses.file.empty() ? run(*arguments, common)
                                                     : run_many(*arguments, common);
            }};
}

} // namespace abut::command
