#include "pair/pieces_queries.h"

#include <abut/error.h>

#include <algorithm>
#include <fmt/format.h>

namespace abut::command {

namespace {

struct TwoSolids {
    TwoSolids(const PairQuery& query, const TwoModels& m)
        : a(pieces_of(m.a, query.models.files[0])), b(pieces_of(m.b, query.models.files[1])) {}
    ConvexPieces a, b;
};

nlohmann::ordered_json describe_counters(const PiecesCounters& counters) {
    return {{"hull_pairs", counters.hull_pairs},
            {"directions", counters.directions},
            {"sphere_pairs", counters.sphere_pairs},
            {"feature_pairs", counters.feature_pairs},
            {"simplices", counters.simplices}};
}

bool is_beyond_bound(const PiecesGap& gap) {
    return gap.status == Status::bound_only;
}

} // namespace

ConvexPieces pieces_of(const Model& model, const std::string& file) {
    try {
        return ConvexPieces(model);
    } catch (const Error& error) {
        throw Error(error.code(), file, error.what());
    }
}

nlohmann::ordered_json describe_pieces(const Mesh& mesh) {
    try {
        const ConvexPieces pieces{Model(mesh)};
        std::size_t largest = 0;
        for (std::size_t i = 0; i < pieces.size(); ++i)
            largest = std::max(largest, pieces.triangles(i).size());
        return {{"pieces", pieces.size()},
                {"triangles", mesh.triangles.size()},
                {"largest", largest},
                {"bytes", pieces.bytes()}};
    } catch (const Error& error) {
        if (error.code() != ErrorCode::bad_mesh)
            throw;
        return {{"pieces", nullptr}, {"triangles", mesh.triangles.size()}, {"error", error.what()}};
    }
}

PiecesGap PiecesDistanceQuery::ask(const TwoModels& m) const {
    const TwoSolids solids(*this, m);
    return distance(solids.a, m.world_from_a, solids.b, m.world_from_b, options);
}

std::vector<PiecesGap> PiecesDistanceQuery::ask(const TwoModels& m,
                                                const std::vector<Placement>& placements) const {
    const TwoSolids solids(*this, m);
    PiecesWarmStart warm_start;
    PiecesDistanceOptions coherent = options;
    coherent.warm_start = &warm_start;
    std::vector<PiecesGap> gaps;
    gaps.reserve(placements.size());
    for (const Placement& p : placements)
        gaps.push_back(distance(solids.a, p.world_from_a, solids.b, p.world_from_b, coherent));
    return gaps;
}

void PiecesDistanceQuery::add_answer(const PiecesGap& gap, nlohmann::ordered_json& json) {
    json["distance"] = gap.distance;
    json["at_least"] = gap.at_least;
    if (!is_beyond_bound(gap)) {
        json["point_a"] = to_json(gap.point_a);
        json["point_b"] = to_json(gap.point_b);
    }
    if (!is_beyond_bound(gap) && gap.distance > 0) {
        json["piece_a"] = gap.piece_a;
        json["piece_b"] = gap.piece_b;
        json["triangle_a"] = gap.triangle_a;
        json["triangle_b"] = gap.triangle_b;
        json["feature_a"] = describe_feature(gap.feature_a, gap.index_a);
        json["feature_b"] = describe_feature(gap.feature_b, gap.index_b);
    }
    json["status"] = to_string(gap.status);
    json["counters"] = describe_counters(gap.counters);
}

std::string PiecesDistanceQuery::in_words(const PiecesGap& gap) {
    if (is_beyond_bound(gap))
        return fmt::format("distance at least {}\n", metres(gap.at_least));
    if (gap.distance == 0)
        return fmt::format("the solids share the point {}\n", point(gap.point_a));
    const std::string at_least =
        gap.status == Status::exact ? "" : fmt::format(" (at least {})", metres(gap.at_least));
    return fmt::format("distance {}{}\n"
                       "point on A {}, triangle {} of piece {}\n"
                       "point on B {}, triangle {} of piece {}\n",
                       metres(gap.distance), at_least, point(gap.point_a), gap.triangle_a,
                       gap.piece_a, point(gap.point_b), gap.triangle_b, gap.piece_b);
}

std::string PiecesDistanceQuery::in_a_line(const PiecesGap& gap) {
    return metres(gap.distance) + "\n";
}

bool PiecesWithinQuery::ask(const TwoModels& m) const {
    const TwoSolids solids(*this, m);
    return within(solids.a, m.world_from_a, solids.b, m.world_from_b, tolerance);
}

std::vector<bool> PiecesWithinQuery::ask(const TwoModels& m,
                                         const std::vector<Placement>& placements) const {
    const TwoSolids solids(*this, m);
    PiecesWarmStart warm_start;
    std::vector<bool> answers;
    answers.reserve(placements.size());
    for (const Placement& p : placements)
        answers.push_back(within(solids.a, p.world_from_a, solids.b, p.world_from_b, tolerance,
                                 {.warm_start = &warm_start}));
    return answers;
}

nlohmann::ordered_json PiecesWithinQuery::question() const {
    nlohmann::ordered_json json = PairQuery::question();
    json["tolerance"] = tolerance;
    return json;
}

void PiecesWithinQuery::add_answer(bool near, nlohmann::ordered_json& json) {
    json["within"] = near;
}

std::string PiecesWithinQuery::in_words(bool near) const {
    return fmt::format("{} {}\n", near ? "within" : "farther than", metres(tolerance));
}

std::string PiecesWithinQuery::in_a_line(bool near) {
    return near ? "within\n" : "farther\n";
}

PiecesContacts PiecesCollideQuery::ask(const TwoModels& m) const {
    const TwoSolids solids(*this, m);
    return collide(solids.a, m.world_from_a, solids.b, m.world_from_b,
                   {.mode = all ? ContactMode::all : ContactMode::first, .triangles = all});
}

std::vector<PiecesContacts>
PiecesCollideQuery::ask(const TwoModels& m, const std::vector<Placement>& placements) const {
    const TwoSolids solids(*this, m);
    PiecesWarmStart warm_start;
    std::vector<PiecesContacts> answers;
    answers.reserve(placements.size());
    for (const Placement& p : placements)
        answers.push_back(collide(solids.a, p.world_from_a, solids.b, p.world_from_b,
                                  {.mode = all ? ContactMode::all : ContactMode::first,
                                   .triangles = all,
                                   .warm_start = &warm_start}));
    return answers;
}

void PiecesCollideQuery::add_answer(const PiecesContacts& contacts,
                                    nlohmann::ordered_json& json) const {
    json["meet"] = contacts.meet;
    json["contact"] = contacts.meet; // the name before 0.1, kept for scripts
    json["contained"] = contacts.contained;
    json["all"] = all;
    json["piece_pairs"] = nlohmann::ordered_json::array();
    for (const PiecePair& pair : contacts.pairs)
        json["piece_pairs"].push_back({pair.a, pair.b});
    if (all)
        json["triangle_pairs"] = to_json(contacts.triangles);
    json["counters"] = describe_counters(contacts.counters);
}

std::string PiecesCollideQuery::in_words(const PiecesContacts& contacts) const {
    std::string text = in_a_line(contacts);
    for (const PiecePair& pair : contacts.pairs)
        text += fmt::format("{} {}\n", pair.a, pair.b);
    return text;
}

std::string PiecesCollideQuery::in_a_line(const PiecesContacts& contacts) {
    return contacts.contained ? "contact: one inside the other\n"
           : contacts.meet
               ? fmt::format("contact: {} pairs of pieces\n", grouped(contacts.pairs.size()))
               : "no contact\n";
}

PiecesDepth PiecesPenetrationQuery::ask(const TwoModels& m) const {
    const TwoSolids solids(*this, m);
    return penetration(solids.a, m.world_from_a, solids.b, m.world_from_b, options);
}

void PiecesPenetrationQuery::add_answer(const PiecesDepth& depth,
                                        nlohmann::ordered_json& json) const {
    json["meet"] = depth.meet;
    json["depth"] = depth.depth;
    json["direction"] = to_json(depth.direction);
    json["point_a"] = to_json(depth.point_a);
    json["point_b"] = to_json(depth.point_b);
    json["piece_a"] = depth.piece_a;
    json["piece_b"] = depth.piece_b;
    if (options.separation)
        json["separation"] = to_json(depth.separation);
    json["status"] = to_string(depth.status);
    json["counters"] = describe_counters(depth.counters);
}

std::string PiecesPenetrationQuery::in_words(const PiecesDepth& depth) const {
    if (!depth.meet)
        return "apart\n";
    std::string text = fmt::format("depth {}{}\n", depth.status == Status::exact ? "" : "at least ",
                                   metres(depth.depth));
    if (options.separation)
        text += fmt::format("separated when B moves by {}\n", point(depth.separation));
    return text;
}

} // namespace abut::command
