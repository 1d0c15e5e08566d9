#include <abut/shape_queries.h>

#include "commands.h"
#include "verbs/one_model.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct NearestArguments {
    OneModelOptions model;
    PointsOptions points;
    bool with_sign = false;
};

int run(const NearestArguments& arguments, const CommonOptions& common) {
    const std::vector<Vec3> points = load(arguments.points);
    const OneModel model = load(arguments.model, common);
    const Stopwatch watch;
    const std::vector<Nearest> results = nearest(model.model, model.world_from_model, points,
                                                 {.signed_distance = arguments.with_sign});
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json answer{{"model", arguments.model.file},
                                      {"frame", model.frame},
                                      {"points", nlohmann::ordered_json::array()}};
        for (std::size_t i = 0; i < points.size(); ++i)
            answer["points"].push_back({{"point", to_json(points[i])},
                                        {"distance", results[i].distance},
                                        {"nearest", to_json(results[i].point)},
                                        {"triangle", results[i].triangle},
                                        {"feature", to_string(results[i].feature)},
                                        {"index", results[i].index},
                                        {"barycentric", results[i].barycentric}});
        answer["seconds"] = describe_seconds(model, seconds);
        print_json(dump(answer));
    } else if (!common.quiet) {
        std::string text;
        for (const Nearest& n : results)
            text += fmt::format("distance {}, point {} on triangle {}\n", metres(n.distance),
                                point(n.point), n.triangle);
        print_text(text);
    }
    return kExitDone;
}

} // namespace

Subcommand add_nearest(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<NearestArguments>();
    CLI::App* app = add_subcommand(
        root, common,
        {"nearest",
         kOneModel,
         "The points of a model's surface that are nearest to given points",
         {{"abut nearest a.obj --point 1,2,3 --signed",
           "the distance is negative if the point lies inside"},
          {"abut nearest a.obj --points points.csv", "for each line x,y,z of a file"}},
         ""});
    add_one_model(*app, arguments->model);
    add_points(*app, arguments->points);
    app->add_flag("--signed", arguments->with_sign,
                  "Negative distances inside (the model must be closed)");
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
