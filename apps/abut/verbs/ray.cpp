#include <abut/shape_queries.h>

#include "commands.h"
#include "verbs/one_model.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct RayArguments {
    OneModelOptions model;
    std::string origin, direction, range;
    bool all = false;
};

const char* to_string(HitSide side) {
    return side == HitSide::front ? "front" : side == HitSide::back ? "back" : "along";
}

Ray parse_ray(const RayArguments& arguments) {
    Ray ray{parse_point("--origin", arguments.origin),
            parse_direction("--direction", arguments.direction)};
    if (!arguments.range.empty()) {
        const std::vector<double> range = parse_numbers("--range", arguments.range, "t0,t1");
        ray.t_min = range[0], ray.t_max = range[1];
    }
    return ray;
}

int run(const RayArguments& arguments, const CommonOptions& common) {
    const Ray ray = parse_ray(arguments);
    const OneModel model = load(arguments.model, common);
    const Stopwatch watch;
    std::vector<RayHit> hits;
    if (arguments.all)
        hits = all_hits(model.model, model.world_from_model, ray);
    else if (const RayHit hit = first_hit(model.model, model.world_from_model, ray); hit.meet)
        hits.push_back(hit);
    const double seconds = watch.seconds();

    if (common.json) {
        nlohmann::ordered_json answer{
            {"model", arguments.model.file},
            {"frame", model.frame},
            {"origin", to_json(ray.origin)},
            {"direction", to_json(ray.direction)},
            {"all", arguments.all},
            {"meet", !hits.empty()},
            {"hit", !hits.empty()}, // the name before 0.1, kept for scripts
            {"hits", nlohmann::ordered_json::array()}};
        for (const RayHit& hit : hits)
            answer["hits"].push_back({{"t", hit.t},
                                      {"point", to_json(hit.point)},
                                      {"triangle", hit.triangle},
                                      {"barycentric", hit.barycentric},
                                      {"side", to_string(hit.side)}});
        answer["seconds"] = describe_seconds(model, seconds);
        print_json(dump(answer));
    } else if (!common.quiet) {
        std::string text = hits.empty() ? "no hit\n" : "";
        for (const RayHit& hit : hits)
            text += fmt::format("t {}, point {} on triangle {}, {}\n", number(hit.t),
                                point(hit.point), hit.triangle, to_string(hit.side));
        print_text(text);
    }
    return kExitDone;
}

} // namespace

Subcommand add_ray(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<RayArguments>();
    CLI::App* app =
        add_subcommand(root, common,
                       {"ray",
                        kOneModel,
                        "Where a ray meets a model's surface",
                        {{"abut ray a.obj --origin 0.5,0.5,9 --direction 0,0,-1",
                          "the first triangle below a point nine metres up"},
                         {"abut ray a.obj --origin 0.5,0.5,9 --direction 0,0,-1 --range 0,20 --all",
                          "every triangle in the next twenty lengths of the direction, in order"}},
                        ""});
    add_one_model(*app, arguments->model);
    app->add_option("--origin", arguments->origin, "Where the ray begins")
        ->required()
        ->check(not_empty("X,Y,Z"));
    app->add_option("--direction", arguments->direction,
                    "Direction of the ray, of any length except zero, which is the unit of t")
        ->required()
        ->check(not_empty("X,Y,Z"));
    app->add_option("--range", arguments->range, "Smallest and largest t (default: 0 to infinity)")
        ->check(not_empty("T0,T1"));
    app->add_flag("--all", arguments->all, "List every triangle that the ray meets, in order");
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
