#include <abut/penetration.h>

#include "commands.h"
#include "two_models.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct PenetrationArguments {
    TwoModelsOptions models;
    PenetrationOptions options;
    bool no_separation = false;
    std::string fail_on;
};

nlohmann::ordered_json describe(const ContactRegion& region) {
    nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
    for (const TrianglePair& pair : region.pairs)
        pairs.push_back({pair.a, pair.b});
    return {{"touching", region.touching},           {"area", region.area},
            {"normal", to_json(region.normal)},      {"depth", region.depth},
            {"depth_at_most", region.depth_at_most}, {"direction", to_json(region.direction)},
            {"point_a", to_json(region.point_a)},    {"point_b", to_json(region.point_b)},
            {"triangle_pairs", std::move(pairs)}};
}

std::string in_words(const Depth& depth, bool separation) {
    if (depth.regions.empty())
        return "apart\n";
    const std::size_t count = depth.regions.size();
    std::string text = depth.interpenetrate
                           ? fmt::format("depth {} (at most {}), {} region{}\n", depth.depth,
                                         depth.depth_at_most, count, count == 1 ? "" : "s")
                           : "touching\n";
    for (const ContactRegion& r : depth.regions)
        text += fmt::format("region: {} triangle pairs, area {}, depth {} at ({}, {}, {})\n",
                            grouped(r.pairs.size()), r.area, r.depth, r.point_a.x, r.point_a.y,
                            r.point_a.z);
    const Vec3& s = depth.separation;
    if (separation)
        text += fmt::format("separated when B moves by ({}, {}, {})\n", s.x, s.y, s.z);
    return text;
}

int run(const PenetrationArguments& arguments, const CommonOptions& common) {
    const TwoModels models = load(arguments.models, common);
    const Stopwatch watch;
    PenetrationOptions options = arguments.options;
    options.separation = !arguments.no_separation;
    const Depth depth =
        penetration(models.a, models.world_from_a, models.b, models.world_from_b, options);
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json regions = nlohmann::ordered_json::array();
        for (const ContactRegion& region : depth.regions)
            regions.push_back(describe(region));
        nlohmann::ordered_json answer = abut::command::describe(arguments.models);
        answer["interpenetrate"] = depth.interpenetrate;
        answer["depth"] = depth.depth;
        answer["depth_at_most"] = depth.depth_at_most;
        answer["direction"] = to_json(depth.direction);
        answer["point_a"] = to_json(depth.point_a);
        answer["point_b"] = to_json(depth.point_b);
        if (options.separation)
            answer["separation"] = to_json(depth.separation);
        answer["regions"] = std::move(regions);
        answer["status"] = to_string(depth.status);
        answer["counters"] = abut::command::describe(depth.counters);
        answer["seconds"] = describe_seconds(models, seconds);
        print(dump(answer));
    } else if (!common.quiet) {
        print(in_words(depth, options.separation));
    }
    return depth.interpenetrate && !arguments.fail_on.empty() ? kExitProblem : kExitDone;
}

} // namespace

Subcommand add_penetration(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<PenetrationArguments>();
    CLI::App* app =
        add_subcommand(root, common, "penetration",
                       "How deep do two models go into each other, where, and which way is out?");
    add_two_models(*app, arguments->models);
    app->add_option("--accuracy", arguments->options.relative_accuracy,
                    "Relative accuracy of the depth (default: 0.01)")
        ->check(not_negative());
    app->add_flag("--no-separation", arguments->no_separation,
                  "Do not look for a translation that separates them");
    app->add_option("--fail-on", arguments->fail_on, "Exit with status 1 on 'penetration'")
        ->check(CLI::IsMember({"penetration"}));
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
