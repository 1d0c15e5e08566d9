#pragma once

#include "pair/two_models.h"

#include <algorithm>
#include <string>

/// Shared code of the queries on two models: ask, print the answer, return the exit status.
namespace abut::command {

/// The base of a query on two models. Each query adds
///
///     ask(models)                returns the answer for the given poses
///     add_answer(answer, json)   adds the answer's fields to the JSON object
///     in_words(answer)           returns the answer as text
///     is_problem(answer)         whether the answer is the problem of --fail-on
///
/// and, if it can be asked for many poses,
///
///     poses                      the option --poses
///     ask(models, placements)    returns the answers, in order
///     in_a_line(answer)          returns one answer as a line of text
struct PairQuery {
    TwoModelsOptions models;
    std::string fail_on; ///< if empty, no answer is a problem

    /// Returns the first members of the JSON object.
    [[nodiscard]] nlohmann::ordered_json question() const { return describe(models); }
    [[nodiscard]] int exit_status(bool problem) const {
        return problem && !fail_on.empty() ? kExitProblem : kExitDone;
    }
};

/// Asks the query for the poses of the command line. Returns the exit status.
template <typename Query>
int run(const Query& query, const CommonOptions& common) {
    const TwoModels models = load(query.models, common);
    const Stopwatch watch;
    const auto answer = query.ask(models);
    const double seconds = watch.seconds();
    if (common.json) {
        nlohmann::ordered_json json = query.question();
        json["frame"] = describe_frame(query.models, models);
        query.add_answer(answer, json);
        json["seconds"] = describe_seconds(models, seconds);
        print_json(dump(json));
    } else if (!common.quiet) {
        print_text(query.in_words(answer));
    }
    return query.exit_status(query.is_problem(answer));
}

/// Asks the query for each pose in the file of --poses. Returns the exit status.
template <typename Query>
int run_many(const Query& query, const CommonOptions& common) {
    const std::vector<Pose> poses = read_poses(query.poses.file);
    const TwoModels models = load(query.models, common);
    const Stopwatch watch;
    const auto answers = query.ask(models, placements(models, poses));
    const double seconds = watch.seconds();
    if (common.json) {
        nlohmann::ordered_json json = query.question();
        json["frame"] = describe_frame(query.models, models);
        json["poses"] = nlohmann::ordered_json::array();
        for (const auto& answer : answers)
            query.add_answer(answer, json["poses"].emplace_back());
        json["seconds"] = describe_seconds(models, seconds);
        print_json(dump(json));
    } else if (!common.quiet) {
        std::string text;
        for (const auto& answer : answers)
            text += query.in_a_line(answer);
        print_text(text);
    }
    return query.exit_status(std::any_of(answers.begin(), answers.end(), [&](const auto& answer) {
        return query.is_problem(answer);
    }));
}

template <typename Query>
int run_one_or_many(const Query& query, const CommonOptions& common) {
    return query.poses.file.empty() ? run(query, common) : run_many(query, common);
}

} // namespace abut::command
