#include "commands.h"
#include "two_models.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct DistanceArguments {
    TwoModelsOptions models;
    PosesOption poses;
    DistanceOptions options;
};

/// Whether the answer is no more than that all points are farther apart than --upper-bound.
bool is_beyond_bound(const Gap& gap) {
    return gap.status == Status::bound_only && gap.distance >= 0;
}

nlohmann::ordered_json describe_feature(Feature kind, std::uint8_t index) {
    return {{"kind", to_string(kind)}, {"index", index}};
}

void add_answer(const Gap& gap, nlohmann::ordered_json& answer) {
    answer["distance"] = gap.distance;
    answer["at_least"] = gap.at_least;
    if (!is_beyond_bound(gap)) {
        answer["point_a"] = to_json(gap.point_a);
        answer["point_b"] = to_json(gap.point_b);
        answer["triangle_a"] = gap.triangle_a;
        answer["triangle_b"] = gap.triangle_b;
        // Of a depth only the triangles are known.
        if (gap.distance >= 0) {
            answer["feature_a"] = describe_feature(gap.feature_a, gap.index_a);
            answer["feature_b"] = describe_feature(gap.feature_b, gap.index_b);
        }
    }
    answer["status"] = to_string(gap.status);
    answer["counters"] = describe(gap.counters);
}

std::string in_words(const Gap& gap) {
    if (is_beyond_bound(gap))
        return fmt::format("distance at least {}\n", gap.at_least);
    const std::string at_least =
        gap.at_least < gap.distance ? fmt::format(" (at least {})", gap.at_least) : "";
    return fmt::format("distance {}{}\n"
                       "point on A ({}, {}, {}), triangle {}\n"
                       "point on B ({}, {}, {}), triangle {}\n",
                       gap.distance, at_least, gap.point_a.x, gap.point_a.y, gap.point_a.z,
                       gap.triangle_a, gap.point_b.x, gap.point_b.y, gap.point_b.z, gap.triangle_b);
}

int run_many(const DistanceArguments& arguments, const CommonOptions& common) {
    const std::vector<Pose> poses = read_poses(arguments.poses.file);
    const TwoModels models = load(arguments.models, common);
    const Stopwatch watch;
    const std::vector<Gap> gaps =
        distance(models.a, models.b, placements(models, poses), arguments.options);
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
    const Gap gap =
        distance(models.a, models.world_from_a, models.b, models.world_from_b, arguments.options);
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json answer = describe(arguments.models);
        add_answer(gap, answer);
        answer["seconds"] = describe_seconds(models, seconds);
        print(dump(answer));
    } else if (!common.quiet) {
        print(in_words(gap));
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
    add_volume(*app, arguments->models);
    DistanceOptions& options = arguments->options;
    app->add_option("--absolute-error", options.absolute_error,
                    "Metres by which the distance may be too large (default 0)")
        ->check(not_negative());
    app->add_option("--relative-error", options.relative_error,
                    "Share of the distance by which it may be too large (default 0)")
        ->check(not_negative());
    app->add_option("--upper-bound", options.upper_bound,
                    "Metres beyond which the distance does not matter (default: none)")
        ->check(not_negative());
    app->add_flag("--signed", options.signed_distance,
                  "Negative, minus the depth, where the models go into each other");
    return {app, [arguments, &common] {
                return arguments->poses.file.empty() ? run(*arguments, common)
                                                     : run_many(*arguments, common);
            }};
}

} // namespace abut::command
