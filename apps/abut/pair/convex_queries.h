#pragma once

#include <abut/convex.h>

#include "pair/pair_query.h"

#include <vector>

/// The queries on the convex hulls of two models (--convex).
namespace abut::command {

struct ConvexDistanceQuery : PairQuery {
    PosesOption poses;
    double absolute_error = 0;

    [[nodiscard]] ConvexGap ask(const TwoModels& m) const;
    [[nodiscard]] std::vector<ConvexGap> ask(const TwoModels& m,
                                             const std::vector<Placement>& placements) const;
    static void add_answer(const ConvexGap& gap, nlohmann::ordered_json& json);
    static std::string in_words(const ConvexGap& gap);
    static std::string in_a_line(const ConvexGap& gap);
    static bool is_problem(const ConvexGap& /*gap*/) { return false; }
};

struct ConvexPenetrationQuery : PairQuery {
    [[nodiscard]] static ConvexDepth ask(const TwoModels& m);
    static void add_answer(const ConvexDepth& depth, nlohmann::ordered_json& json);
    static std::string in_words(const ConvexDepth& depth);
    static bool is_problem(const ConvexDepth& depth) { return depth.depth > 0; }
};

} // namespace abut::command
