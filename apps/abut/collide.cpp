#include "commands.h"
#include "two_models.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct CollideArguments {
    TwoModelsOptions models;
    PosesOption poses;
    bool all = false;
    bool segments = false;
    std::string fail_on;
};

CollideOptions options_of(const CollideArguments& arguments) {
    return {.mode = arguments.all ? ContactMode::all : ContactMode::first,
            .segments = arguments.segments};
}

nlohmann::ordered_json to_json(const Intersection& shared) {
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (std::uint32_t i = 0; i < shared.count; ++i)
        points.push_back(command::to_json(shared.corners.at(i)));
    return points;
}

void add_answer(const CollideArguments& arguments, const Contacts& contacts,
                nlohmann::ordered_json& answer) {
    nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
    for (const TrianglePair& pair : contacts.pairs)
        pairs.push_back({pair.a, pair.b});
    answer["contact"] = contacts.any();
    answer["all"] = arguments.all;
    answer["triangle_pairs"] = std::move(pairs);
    if (arguments.segments) {
        nlohmann::ordered_json segments = nlohmann::ordered_json::array();
        for (const Intersection& shared : contacts.segments)
            segments.push_back(to_json(shared));
        answer["segments"] = std::move(segments);
    }
    answer["status"] = to_string(contacts.status);
    answer["counters"] = describe(contacts.counters);
}

int run_many(const CollideArguments& arguments, const CommonOptions& common) {
    const std::vector<Pose> poses = read_poses(arguments.poses.file);
    const TwoModels models = load(arguments.models, common);
    const Stopwatch watch;
    const std::vector<Contacts> all =
        collide(models.a, models.b, placements(models, poses), options_of(arguments));
    const double seconds = watch.seconds();
    if (common.json) {
        nlohmann::ordered_json answer = describe(arguments.models);
        answer["poses"] = nlohmann::ordered_json::array();
        for (const Contacts& contacts : all)
            add_answer(arguments, contacts, answer["poses"].emplace_back());
        answer["seconds"] = describe_seconds(models, seconds);
        print(dump(answer));
    } else if (!common.quiet) {
        std::string text;
        for (const Contacts& contacts : all)
            text += !contacts.any() ? "no contact\n"
                    : arguments.all ? fmt::format("contact: {} triangle pairs\n",
                                                  grouped(contacts.pairs.size()))
                                    : "contact\n";
        print(text);
    }
    const bool any = std::any_of(all.begin(), all.end(), [](const Contacts& c) { return c.any(); });
    return any && !arguments.fail_on.empty() ? kExitProblem : kExitDone;
}

int run(const CollideArguments& arguments, const CommonOptions& common) {
    const TwoModels models = load(arguments.models, common);
    const Stopwatch watch;
    const Contacts contacts = collide(models.a, models.world_from_a, models.b, models.world_from_b,
                                      options_of(arguments));
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json answer = describe(arguments.models);
        add_answer(arguments, contacts, answer);
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
    add_poses(*app, arguments->poses);
    add_volume(*app, arguments->models);
    app->add_flag("--all", arguments->all, "List every pair of triangles that meet");
    app->add_flag("--segments", arguments->segments,
                  "With --json: also the points that each pair shares");
    app->add_option("--fail-on", arguments->fail_on, "Exit with status 1 on 'contact'")
        ->check(CLI::IsMember({"contact"}));
    return {app, [arguments, &common] {
                return arguments->poses.file.empty() ? run(*arguments, common)
                                                     : run_many(*arguments, common);
            }};
}

} // namespace abut::command
