#include "commands.h"
#include "two_models.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct DistanceArguments {
    TwoModelsOptions models;
    PosesOption poses;
};

void add_answer(const Gap& gap, nlohmann::ordered_json& answer) {
    answer["distance"] = gap.distance;
    answer["point_a"] = to_json(gap.point_a);
    answer["point_b"] = to_json(gap.point_b);
    answer["triangle_a"] = gap.triangle_a;
    answer["triangle_b"] = gap.triangle_b;
    answer["status"] = to_string(gap.status);
    answer["counters"] = describe(gap.counters);
}

int run_many(const DistanceArguments& arguments, const CommonOptions& common) {
    const std::vector<Pose> poses = read_poses(arguments.poses.file);
    const TwoModels models = load(arguments.models, common);
    const Stopwatch watch;
    const std::vector<Gap> gaps = distance(models.a, models.b, placements(models, poses));
    const double seconds = watch.seconds();
    if (common.json) {
        nlohmann::ordered_json answer = describe(arguments.models);
        answer["poses"] = nlohmann::ordered_json::array();
        for (const Gap& gap : gaps)
            add_answer(gap, answer["poses"].emplace_back());
        answer["seconds"] = describe_seconds(models, seconds);
        print(dump(answer));
    } else if (!common.quiet) {
        std::string text;
        for (const Gap& gap : gaps)
            text += fmt::format("{}\n", gap.distance);
        print(text);
    }
    return kExitDone;
}

int run(const DistanceArguments& arguments, const CommonOptions& common) {
    const TwoModels models = load(arguments.models, common);
    const Stopwatch watch;
    const Gap gap = distance(models.a, models.world_from_a, models.b, models.world_from_b);
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json answer = describe(arguments.models);
        add_answer(gap, answer);
        answer["seconds"] = describe_seconds(models, seconds);
        print(dump(answer));
    } else if (!common.quiet) {
        print(fmt::format("distance {}\n"
                          "point on A ({}, {}, {}), triangle {}\n"
                          "point on B ({}, {}, {}), triangle {}\n",
                          gap.distance, gap.point_a.x, gap.point_a.y, gap.point_a.z, gap.triangle_a,
                          gap.point_b.x, gap.point_b.y, gap.point_b.z, gap.triangle_b));
    }
    return kExitDone;
}

} // namespace

Subcommand add_distance(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<DistanceArguments>();
    CLI::App* app = add_subcommand(root, common, "distance",
                                   "Distance of the surfaces of two models, and closest points");
    add_two_models(*app, arguments->models);
    add_poses(*app, arguments->poses);
    return {app, [arguments, &common] {
                return arguments->poses.file.empty() ? run(*arguments, common)
                                                     : run_many(*arguments, common);
            }};
}

} // namespace abut::command
