#include "commands.h"
#include "pair/pair_query.h"
#include "pair/pieces_queries.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct WithinQuery : PairQuery {
    PosesOption poses;
    double tolerance = 0;
    bool pieces = false; ///< treats the models as solids of convex pieces

    [[nodiscard]] bool ask(const TwoModels& m) const {
        return within(m.a, m.world_from_a, m.b, m.world_from_b, tolerance);
    }
    [[nodiscard]] std::vector<bool> ask(const TwoModels& m,
                                        const std::vector<Placement>& placements) const {
        return within(m.a, m.b, placements, tolerance);
    }
    [[nodiscard]] nlohmann::ordered_json question() const {
        nlohmann::ordered_json json = PairQuery::question();
        json["tolerance"] = tolerance;
        return json;
    }
    static void add_answer(bool near, nlohmann::ordered_json& json) { json["within"] = near; }
    [[nodiscard]] std::string in_words(bool near) const {
        return fmt::format("{} {}\n", near ? "within" : "farther than", metres(tolerance));
    }
    static std::string in_a_line(bool near) { return near ? "within\n" : "farther\n"; }
    static bool is_problem(bool near) { return near; }
};

} // namespace

Subcommand add_within(CLI::App& root, CommonOptions& common) {
    auto query = std::make_shared<WithinQuery>();
    CLI::App* app = add_subcommand(
        root, common,
        {"within",
         kTwoModels,
         "Are two models at most a tolerance apart, or in contact?",
         {{"abut within a.obj b.stl --tolerance 5mm", "at most five millimetres apart?"},
          {"abut within a.obj b.stl --tolerance 0.5 --pose-b 1.5,0,0,1,0,0,0 --fail-on within",
           "with B moved by 1.5 m; exit status 1 if they are at most half a metre apart"}},
         "the models are within the tolerance (with --fail-on within)"});
    add_two_models(*app, query->models);
    add_poses(*app, query->poses);
    add_volume(*app, query->models);
    add_length(*app, "--tolerance", query->tolerance, "Distance")->required();
    add_fail_on(*app, query->fail_on, "within");
    app->add_flag("--pieces", query->pieces, "Treat the models as solids made of convex pieces")
        ->excludes(app->get_option("--volume"));
    return {app, [query, &common] {
                if (query->pieces)
                    return run_one_or_many(
                        PiecesWithinQuery{*query, query->poses, query->tolerance}, common);
                return run_one_or_many(*query, common);
            }};
}

} // namespace abut::command
