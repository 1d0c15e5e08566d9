#include "commands.h"
#include "two_models.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct WithinArguments {
    TwoModelsOptions models;
    double tolerance = 0;
    std::string fail_on;
};

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
    app->add_option("--tolerance", arguments->tolerance, "Distance in metres")
        ->required()
        ->check(not_negative());
    app->add_option("--fail-on", arguments->fail_on, "Exit with status 1 on 'within'")
        ->check(CLI::IsMember({"within"}));
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
