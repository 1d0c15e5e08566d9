#include <abut/penetration.h>

#include "commands.h"
#include "pair/convex_queries.h"
#include "pair/pair_query.h"
#include "pair/pieces_queries.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

nlohmann::ordered_json describe_region(const ContactRegion& region) {
    return {{"touching", region.touching},
            {"area", region.area},
            {"normal", to_json(region.normal)},
            {"depth", region.depth},
            {"depth_at_most", region.depth_at_most},
            {"direction", to_json(region.direction)},
            {"point_a", to_json(region.point_a)},
            {"point_b", to_json(region.point_b)},
            {"triangle_pairs", to_json(region.pairs)}};
}

struct PenetrationQuery : PairQuery {
    PenetrationOptions options;
    bool convex = false; ///< measures the models' convex hulls
    bool pieces = false; ///< treats the models as solids of convex pieces

    [[nodiscard]] Depth ask(const TwoModels& m) const {
        return penetration(m.a, m.world_from_a, m.b, m.world_from_b, options);
    }
    void add_answer(const Depth& depth, nlohmann::ordered_json& json) const {
        json["meet"] = depth.meet;
        json["interpenetrate"] = depth.interpenetrate;
        json["depth"] = depth.depth;
        json["depth_at_most"] = depth.depth_at_most;
        json["direction"] = to_json(depth.direction);
        json["point_a"] = to_json(depth.point_a);
        json["point_b"] = to_json(depth.point_b);
        if (options.separation)
            json["separation"] = to_json(depth.separation);
        json["regions"] = nlohmann::ordered_json::array();
        for (const ContactRegion& region : depth.regions)
            json["regions"].push_back(describe_region(region));
        json["status"] = to_string(depth.status);
        json["out_of_steps"] = depth.out_of_steps;
        json["steps"] = depth.steps;
        json["counters"] = describe(depth.counters);
    }
    [[nodiscard]] std::string in_words(const Depth& depth) const {
        const std::string limited =
            depth.out_of_steps ? fmt::format(": {} steps were not enough", grouped(depth.steps))
                               : "";
        if (depth.regions.empty())
            return depth.out_of_steps ? fmt::format("not decided whether they meet; depth at most "
                                                    "{}{}\n",
                                                    metres_above(depth.depth_at_most), limited)
                                      : "apart\n";
        const std::size_t count = depth.regions.size();
        std::string text =
            depth.interpenetrate
                ? fmt::format("depth {} (at most {}), {} region{}{}\n", metres(depth.depth),
                              depth.out_of_steps ? metres_above(depth.depth_at_most)
                                                 : metres(depth.depth_at_most),
                              count, count == 1 ? "" : "s", limited)
                : "touching\n";
        for (const ContactRegion& r : depth.regions)
            text += fmt::format("region: {} triangle pairs, area {} m^2, depth {} at {}\n",
                                grouped(r.pairs.size()), number(r.area), metres(r.depth),
                                point(r.point_a));
        if (options.separation)
            text += fmt::format("separated when B moves by {}\n", point(depth.separation));
        return text;
    }
    static bool is_problem(const Depth& depth) { return depth.interpenetrate; }
};

} // namespace

Subcommand add_penetration(CLI::App& root, CommonOptions& common) {
    auto query = std::make_shared<PenetrationQuery>();
    CLI::App* app = add_subcommand(
        root, common,
        {"penetration",
         kTwoModels,
         "How deep do two models penetrate each other, where, and what separates them?",
         {{"abut penetration a.obj b.stl --pose-b 0.9,0.2,0.3,1,0,0,0",
           "depth, regions of contact, and a translation of B that separates them"},
          {"abut penetration a.obj b.stl --relative-error 0.001 --fail-on penetration",
           "the depth to a thousandth; exit status 1 if the models penetrate"}},
         "the models penetrate each other (with --fail-on penetration)"});
    add_two_models(*app, query->models);
    app->add_option("--relative-error,--accuracy", query->options.relative_error,
                    "Relative error allowed for the depth (default 0.01)")
        ->check(not_negative());
    app->add_flag_callback(
        "--no-separation", [&options = query->options] { options.separation = false; },
        "Do not search for a translation that separates the models");
    app->add_option("--max-steps", query->options.max_steps,
                    "End the search after N steps (pairs of boxes or points) and print what is "
                    "proven so far (default: no limit)")
        ->type_name("N")
        ->check(not_negative());
    add_fail_on(*app, query->fail_on, "penetration");
    CLI::Option* convex =
        app->add_flag("--convex", query->convex, "Use the convex hulls of the models");
    for (const char* other : {"--relative-error", "--no-separation", "--max-steps"})
        convex->excludes(app->get_option(other));
    CLI::Option* pieces = app->add_flag("--pieces", query->pieces,
                                        "Treat the models as solids made of convex pieces");
    for (const char* other : {"--relative-error", "--convex", "--max-steps"})
        pieces->excludes(app->get_option(other));
    return {app, [query, &common] {
                if (query->pieces)
                    return run(PiecesPenetrationQuery{*query, {query->options.separation}}, common);
                return query->convex ? run(ConvexPenetrationQuery{*query}, common)
                                     : run(*query, common);
            }};
}

} // namespace abut::command
