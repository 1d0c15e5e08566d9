#include "commands.h"
#include "two_models.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

int run(const TwoModelsOptions& options, const CommonOptions& common) {
    const TwoModels models = load(options, common);
    const Stopwatch watch;
    const Gap gap = distance(models.a, models.world_from_a, models.b, models.world_from_b);
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json answer = describe(options);
        answer["distance"] = gap.distance;
        answer["point_a"] = to_json(gap.point_a);
        answer["point_b"] = to_json(gap.point_b);
        answer["triangle_a"] = gap.triangle_a;
        answer["triangle_b"] = gap.triangle_b;
        answer["status"] = to_string(gap.status);
        answer["counters"] = describe(gap.counters);
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
    auto options = std::make_shared<TwoModelsOptions>();
    CLI::App* app = add_subcommand(root, common, "distance",
                                   "Distance of the surfaces of two models, and closest points");
    add_two_models(*app, *options);
    return {app, [options, &common] { return run(*options, common); }};
}

} // namespace abut::command
