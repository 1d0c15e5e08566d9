#include "pair/convex_queries.h"

#include <fmt/format.h>

namespace abut::command {

namespace {

Convex hull_of(const Model& model) {
    return Convex(model.mesh().positions);
}

nlohmann::ordered_json describe_hull_feature(Feature kind, std::uint32_t id) {
    return {{"kind", to_string(kind)}, {"id", id}};
}

nlohmann::ordered_json describe_work(const ConvexCounters& counters) {
    return {{"feature_pairs", counters.feature_pairs}, {"simplices", counters.simplices}};
}

} // namespace

ConvexGap ConvexDistanceQuery::ask(const TwoModels& m) const {
    return distance(hull_of(m.a), m.world_from_a, hull_of(m.b), m.world_from_b,
                    {.absolute_error = absolute_error});
}

std::vector<ConvexGap> ConvexDistanceQuery::ask(const TwoModels& m,
                                                const std::vector<Placement>& placements) const {
    const Convex a = hull_of(m.a), b = hull_of(m.b);
    ConvexWarmStart warm_start;
    std::vector<ConvexGap> gaps;
    gaps.reserve(placements.size());
    for (const Placement& p : placements)
        gaps.push_back(distance(a, p.world_from_a, b, p.world_from_b,
                                {.absolute_error = absolute_error, .warm_start = &warm_start}));
    return gaps;
}

void ConvexDistanceQuery::add_answer(const ConvexGap& gap, nlohmann::ordered_json& json) {
    json["distance"] = gap.distance;
    json["at_least"] = gap.at_least;
    json["point_a"] = to_json(gap.point_a);
    json["point_b"] = to_json(gap.point_b);
    if (gap.distance > 0) {
        json["feature_a"] = describe_hull_feature(gap.feature_a, gap.id_a);
        json["feature_b"] = describe_hull_feature(gap.feature_b, gap.id_b);
    }
    json["status"] = to_string(gap.status);
    json["counters"] = describe_work(gap.counters);
}

std::string ConvexDistanceQuery::in_words(const ConvexGap& gap) {
    if (gap.distance == 0)
        return fmt::format("the hulls meet at {}\n", point(gap.point_a));
    const std::string at_least =
        gap.status == Status::exact ? "" : fmt::format(" (at least {})", metres(gap.at_least));
    return fmt::format("distance {}{}\n"
                       "point on the hull of A {}, {} {}\n"
                       "point on the hull of B {}, {} {}\n",
                       metres(gap.distance), at_least, point(gap.point_a), to_string(gap.feature_a),
                       gap.id_a, point(gap.point_b), to_string(gap.feature_b), gap.id_b);
}

std::string ConvexDistanceQuery::in_a_line(const ConvexGap& gap) {
    return metres(gap.distance) + "\n";
}

ConvexDepth ConvexPenetrationQuery::ask(const TwoModels& m) {
    return penetration(hull_of(m.a), m.world_from_a, hull_of(m.b), m.world_from_b);
}

void ConvexPenetrationQuery::add_answer(const ConvexDepth& depth, nlohmann::ordered_json& json) {
    json["meet"] = depth.meet;
    json["depth"] = depth.depth;
    json["at_least"] = depth.at_least;
    json["direction"] = to_json(depth.direction);
    json["point_a"] = to_json(depth.point_a);
    json["point_b"] = to_json(depth.point_b);
    json["status"] = to_string(depth.status);
    json["counters"] = describe_work(depth.counters);
}

std::string ConvexPenetrationQuery::in_words(const ConvexDepth& depth) {
    if (!depth.meet)
        return "apart\n";
    return fmt::format("depth {}, separated when B moves along {}\n", metres(depth.depth),
                       direction(depth.direction));
}

} // namespace abut::command
