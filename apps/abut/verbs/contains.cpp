#include <abut/shape_queries.h>

#include "commands.h"
#include "verbs/one_model.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct ContainsArguments {
    OneModelOptions model;
    PointsOptions points;
    std::string fail_on;
};

const char* name_of_side(Side side) {
    return side == Side::inside ? "inside" : side == Side::outside ? "outside" : "on_surface";
}
const char* name_of_method(ContainmentMethod method) {
    return method == ContainmentMethod::crossings ? "crossings" : "winding";
}

int run(const ContainsArguments& arguments, const CommonOptions& common) {
    const std::vector<Vec3> points = load(arguments.points);
    const OneModel model = load(arguments.model, common);
    const Stopwatch watch;
    const std::vector<Containment> results = contains(model.model, model.world_from_model, points);
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json answer{{"model", arguments.model.file},
                                      {"frame", model.frame},
                                      {"method", name_of_method(results[0].method)},
                                      {"points", nlohmann::ordered_json::array()}};
        for (std::size_t i = 0; i < points.size(); ++i) {
            answer["points"].push_back(
                {{"point", to_json(points[i])}, {"side", name_of_side(results[i].side)}});
            if (results[i].method == ContainmentMethod::winding)
                answer["points"].back()["winding_number"] = results[i].winding_number;
        }
        answer["seconds"] = describe_seconds(model, seconds);
        print_json(dump(answer));
    } else if (!common.quiet) {
        std::string text;
        for (const Containment& c : results)
            text += c.method == ContainmentMethod::crossings
                        ? fmt::format("{}\n", name_of_side(c.side))
                        : fmt::format("{} (not closed; winding number {})\n", name_of_side(c.side),
                                      number(c.winding_number));
        print_text(text);
    }
    const bool fails = std::any_of(results.begin(), results.end(), [&](const Containment& c) {
        return name_of_side(c.side) == arguments.fail_on;
    });
    return fails ? kExitProblem : kExitDone;
}

} // namespace

Subcommand add_contains(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<ContainsArguments>();
    CLI::App* app =
        add_subcommand(root, common,
                       {"contains",
                        kOneModel,
                        "Are points inside a model, outside, or on its surface?",
                        {{"abut contains a.obj --point 0.5,0.5,0.5", "one point"},
                         {"abut contains a.obj --points points.csv --fail-on inside",
                          "one point x,y,z per line; exit status 1 if any lies inside"}},
                        "a point lies where --fail-on says"});
    add_one_model(*app, arguments->model);
    add_points(*app, arguments->points);
    app->add_option("--fail-on", arguments->fail_on,
                    "Exit with status 1 if a point is 'inside', 'outside' or 'on_surface'")
        ->check(CLI::IsMember({"inside", "outside", "on_surface"}));
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
