#include <abut/shape_queries.h>

#include "commands.h"
#include "one_model.h"

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

const char* to_string(Side side) {
    return side == Side::inside ? "inside" : side == Side::outside ? "outside" : "on_surface";
}
const char* to_string(ContainmentMethod method) {
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
                                      {"method", to_string(results[0].method)},
                                      {"points", nlohmann::ordered_json::array()}};
        for (std::size_t i = 0; i < points.size(); ++i) {
            answer["points"].push_back(
                {{"point", to_json(points[i])}, {"side", to_string(results[i].side)}});
            if (results[i].method == ContainmentMethod::winding)
                answer["points"].back()["winding_number"] = results[i].winding_number;
        }
        answer["seconds"] = describe_seconds(model, seconds);
        print(dump(answer));
    } else if (!common.quiet) {
        std::string text;
        for (const Containment& c : results)
            text += c.method == ContainmentMethod::crossings
                        ? fmt::format("{}\n", to_string(c.side))
                        : fmt::format("{} (not closed; winding number {})\n", to_string(c.side),
                                      c.winding_number);
        print(text);
    }
    const bool fails = std::any_of(results.begin(), results.end(), [&](const Containment& c) {
        return to_string(c.side) == arguments.fail_on;
    });
    return fails ? kExitProblem : kExitDone;
}

} // namespace

Subcommand add_contains(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<ContainsArguments>();
    CLI::App* app = add_subcommand(root, common, "contains",
                                   "Are points inside a model, outside, or on its surface?");
    add_one_model(*app, arguments->model);
    add_points(*app, arguments->points);
    app->add_option("--fail-on", arguments->fail_on,
                    "Exit with status 1 if some point is 'inside', 'outside' or 'on_surface'")
        ->check(CLI::IsMember({"inside", "outside", "on_surface"}));
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
