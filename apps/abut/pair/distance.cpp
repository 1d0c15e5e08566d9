#include "commands.h"
#include "pair/convex_queries.h"
#include "pair/pair_query.h"
#include "pair/pieces_queries.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

/// Returns whether the answer says only that the models are farther apart than --upper-bound.
bool is_beyond_bound(const Gap& gap) {
    return gap.status == Status::bound_only && gap.distance >= 0 && !gap.out_of_steps;
}

struct DistanceQuery : PairQuery {
    PosesOption poses;
    bool convex = false; ///< measures the models' convex hulls
    bool pieces = false; ///< treats the models as solids of convex pieces
    DistanceOptions options;

    [[nodiscard]] Gap ask(const TwoModels& m) const {
        return distance(m.a, m.world_from_a, m.b, m.world_from_b, options);
    }
    [[nodiscard]] std::vector<Gap> ask(const TwoModels& m,
                                       const std::vector<Placement>& placements) const {
        return distance(m.a, m.b, placements, options);
    }
    static void add_answer(const Gap& gap, nlohmann::ordered_json& json) {
        json["distance"] = gap.distance;
        json["at_least"] = gap.at_least;
        if (!is_beyond_bound(gap)) {
            json["point_a"] = to_json(gap.point_a);
            json["point_b"] = to_json(gap.point_b);
            json["triangle_a"] = gap.triangle_a;
            json["triangle_b"] = gap.triangle_b;
            // For a depth only the triangles are known, not the features.
            if (gap.distance >= 0) {
                json["feature_a"] = describe_feature(gap.feature_a, gap.index_a);
                json["feature_b"] = describe_feature(gap.feature_b, gap.index_b);
            }
        }
        json["status"] = to_string(gap.status);
        json["out_of_steps"] = gap.out_of_steps;
        json["steps"] = gap.steps;
        json["counters"] = describe(gap.counters);
    }
    static std::string in_words(const Gap& gap) {
        if (is_beyond_bound(gap))
            return fmt::format("distance at least {}\n", metres(gap.at_least));
        if (gap.out_of_steps)
            return fmt::format("distance at least {}, at most {}: {} steps were not enough\n",
                               metres_below(gap.at_least), metres_above(gap.distance),
                               grouped(gap.steps));
        // The two bounds of an exact distance differ only by rounding.
        const std::string at_least =
            gap.status == Status::exact ? "" : fmt::format(" (at least {})", metres(gap.at_least));
        return fmt::format("distance {}{}\n"
                           "point on A {}, triangle {}\n"
                           "point on B {}, triangle {}\n",
                           metres(gap.distance), at_least, point(gap.point_a), gap.triangle_a,
                           point(gap.point_b), gap.triangle_b);
    }
    static std::string in_a_line(const Gap& gap) { return metres(gap.distance) + "\n"; }
    static bool is_problem(const Gap& /*gap*/) { return false; }
};

} // namespace

Subcommand add_distance(CLI::App& root, CommonOptions& common) {
    auto query = std::make_shared<DistanceQuery>();
    CLI::App* app = add_subcommand(
        root, common,
        {"distance",
         kTwoModels,
         "Distance of the surfaces of two models, and closest points",
         {{"abut distance a.obj b.stl --pose-b 3,0,0,1,0,0,0", "with B moved by three metres"},
          {"abut distance a.obj b.stl --poses poses.csv --json",
           "the distance for each pose of B in a file, as JSON"}},
         ""});
    add_two_models(*app, query->models);
    add_poses(*app, query->poses);
    add_volume(*app, query->models);
    DistanceOptions& options = query->options;
    add_length(*app, "--absolute-error", options.absolute_error,
               "Absolute error allowed: a length (default 0)");
    app->add_option("--relative-error", options.relative_error,
                    "Relative error allowed: a fraction of the distance (default 0)")
        ->check(not_negative());
    add_length(*app, "--upper-bound", options.upper_bound,
               "Stop when the distance is proven to be larger than this (default: none)");
    app->add_flag("--signed", options.signed_distance,
                  "Give minus the depth where the models penetrate each other");
    app->add_option("--max-steps", options.max_steps,
                    "End the search after N steps (pairs of boxes, or points of a depth) and print "
                    "what is proven so far (default: no limit)")
        ->type_name("N")
        ->check(not_negative());
    CLI::Option* convex =
        app->add_flag("--convex", query->convex, "Use the convex hulls of the models, as solids");
    for (const char* other :
         {"--relative-error", "--upper-bound", "--signed", "--volume", "--max-steps"})
        convex->excludes(app->get_option(other));
    CLI::Option* pieces = app->add_flag("--pieces", query->pieces,
                                        "Treat the models as solids made of convex pieces");
    for (const char* other :
         {"--relative-error", "--signed", "--volume", "--convex", "--max-steps"})
        pieces->excludes(app->get_option(other));
    return {app, [query, &common] {
                if (query->pieces)
                    return run_one_or_many(
                        PiecesDistanceQuery{*query,
                                            query->poses,
                                            {.upper_bound = query->options.upper_bound,
                                             .absolute_error = query->options.absolute_error}},
                        common);
                if (query->convex)
                    return run_one_or_many(
                        ConvexDistanceQuery{*query, query->poses, query->options.absolute_error},
                        common);
                return run_one_or_many(*query, common);
            }};
}

} // namespace abut::command
