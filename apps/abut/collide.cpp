#include "commands.h"
#include "two_models.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct CollideArguments {
    TwoModelsOptions models;
    bool all = false;
    bool segments = false;
    std::string fail_on;
};

nlohmann::ordered_json describe(const Intersection& shared) {
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (std::uint32_t i = 0; i < shared.count; ++i)
        points.push_back(to_json(shared.corners.at(i)));
    return points;
}

int run(const CollideArguments& arguments, const CommonOptions& common) {
    const TwoModels models = load(arguments.models, common);
    const Stopwatch watch;
    const Contacts contacts =
        collide(models.a, models.world_from_a, models.b, models.world_from_b,
                {.mode = arguments.all ? ContactMode::all : ContactMode::first,
                 .segments = arguments.segments});
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
        for (const TrianglePair& pair : contacts.pairs)
            pairs.push_back({pair.a, pair.b});
        nlohmann::ordered_json answer = abut::command::describe(arguments.models);
        answer["contact"] = contacts.any();
        answer["all"] = arguments.all;
        answer["triangle_pairs"] = std::move(pairs);
        if (arguments.segments) {
            nlohmann::ordered_json segments = nlohmann::ordered_json::array();
            for (const Intersection& shared : contacts.segments)
                segments.push_back(describe(shared));
            answer["segments"] = std::move(segments);
        }
        answer["status"] = to_string(contacts.status);
        answer["counters"] = abut::command::describe(contacts.counters);
        answer["seconds"] = describe_seconds(models, seconds);
        print(dump(answer));
    } else if (!common.quiet) {
        std::string text;
        if (!contacts.any())
            text = "no contact\n";
        else if (arguments.all)
            text = fmt::format("contact: {} triangle pairs\n", grouped(contacts.pairs.size()));
        else
            text = fmt::format("contact: triangle {} of A, triangle {} of B\n",
                               contacts.pairs.front().a, contacts.pairs.front().b);
        if (arguments.all)
            for (const TrianglePair& pair : contacts.pairs)
                text += fmt::format("{} {}\n", pair.a, pair.b);
        print(text);
    }
    return contacts.any() && !arguments.fail_on.empty() ? kExitProblem : kExitDone;
}

} // namespace

Subcommand add_collide(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<CollideArguments>();
    CLI::App* app =
        add_subcommand(root, common, "collide", "Do the surfaces of two models share a point?");
    add_two_models(*app, arguments->models);
    app->add_flag("--all", arguments->all, "List every pair of triangles that meet");
    app->add_flag("--segments", arguments->segments,
                  "With --json: also the points that each pair shares");
    app->add_option("--fail-on", arguments->fail_on, "Exit with status 1 on 'contact'")
        ->check(CLI::IsMember({"contact"}));
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
