#include "commands.h"
#include "pair/pair_query.h"
#include "pair/pieces_queries.h"

#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

nlohmann::ordered_json points_of(const Intersection& shared) {
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (std::uint32_t i = 0; i < shared.count; ++i)
        points.push_back(to_json(shared.corners.at(i)));
    return points;
}

std::string describe_points(const Intersection& shared) {
    std::string points;
    for (std::uint32_t i = 0; i < shared.count; ++i)
        points += (i == 0 ? "" : ", ") + direction(shared.corners.at(i));
    return fmt::format("{} {} m",
                       shared.count == 1   ? "point"
                       : shared.count == 2 ? "segment"
                                           : "polygon",
                       points);
}

struct CollideQuery : PairQuery {
    PosesOption poses;
    bool all = false;
    bool segments = false;
    bool pieces = false; ///< treats the models as solids of convex pieces

    [[nodiscard]] CollideOptions options() const {
        return {.mode = all ? ContactMode::all : ContactMode::first, .segments = segments};
    }
    [[nodiscard]] Contacts ask(const TwoModels& m) const {
        return collide(m.a, m.world_from_a, m.b, m.world_from_b, options());
    }
    [[nodiscard]] std::vector<Contacts> ask(const TwoModels& m,
                                            const std::vector<Placement>& placements) const {
        return collide(m.a, m.b, placements, options());
    }
    void add_answer(const Contacts& contacts, nlohmann::ordered_json& json) const {
        json["meet"] = contacts.meet();
        json["contact"] = contacts.meet(); // the name before 0.1, kept for scripts
        json["all"] = all;
        json["triangle_pairs"] = to_json(contacts.pairs);
        if (segments) {
            json["segments"] = nlohmann::ordered_json::array();
            for (const Intersection& shared : contacts.segments)
                json["segments"].push_back(points_of(shared));
        }
        json["status"] = to_string(contacts.status);
        json["counters"] = describe(contacts.counters);
    }
    [[nodiscard]] std::string in_words(const Contacts& contacts) const {
        if (contacts.meet() && !all)
            return fmt::format("contact: triangle {} of A, triangle {} of B{}\n",
                               contacts.pairs.front().a, contacts.pairs.front().b,
                               segments ? ", " + describe_points(contacts.segments.front()) : "");
        std::string text = in_a_line(contacts);
        for (std::size_t i = 0; i < contacts.pairs.size(); ++i)
            text += fmt::format("{} {}{}\n", contacts.pairs[i].a, contacts.pairs[i].b,
                                segments ? "  " + describe_points(contacts.segments.at(i)) : "");
        return text;
    }
    [[nodiscard]] std::string in_a_line(const Contacts& contacts) const {
        return !contacts.meet() ? "no contact\n"
               : all ? fmt::format("contact: {} triangle pairs\n", grouped(contacts.pairs.size()))
                     : "contact\n";
    }
    static bool is_problem(const Contacts& contacts) { return contacts.meet(); }
};

} // namespace

Subcommand add_collide(CLI::App& root, CommonOptions& common) {
    auto query = std::make_shared<CollideQuery>();
    CLI::App* app = add_subcommand(
        root, common,
        {"collide",
         kTwoModels,
         "Do the surfaces of two models share a point?",
         {{"abut collide a.obj b.stl --pose-b 0,0,2,1,0,0,0 --fail-on contact",
           "is there a contact with B two metres higher? Exit status 1 on contact"},
          {"abut collide a.obj b.stl --all --segments",
           "lists every pair of triangles that meet, and the points that they share"}},
         "the surfaces share a point (with --fail-on contact)"});
    add_two_models(*app, query->models);
    add_poses(*app, query->poses);
    add_volume(*app, query->models);
    app->add_flag("--all", query->all, "List every pair of triangles that meet");
    app->add_flag("--segments", query->segments,
                  "Also compute the points that each pair of triangles shares");
    add_fail_on(*app, query->fail_on, "contact");
    CLI::Option* pieces = app->add_flag("--pieces", query->pieces,
                                        "Treat the models as solids made of convex pieces");
    for (const char* other : {"--segments", "--volume"})
        pieces->excludes(app->get_option(other));
    return {app, [query, &common] {
                if (query->pieces)
                    return run_one_or_many(PiecesCollideQuery{*query, query->poses, query->all},
                                           common);
                return run_one_or_many(*query, common);
            }};
}

} // namespace abut::command
