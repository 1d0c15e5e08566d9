#pragma once

#include <abut/store.h>
#include <abut/topics.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace abut::command {

/// The options of abut review that change topics.
struct TopicArguments {
    std::vector<std::string> topics; ///< ids of groups or clashes, or GUIDs
    std::optional<std::string> assignee, due, comment, status, priority, title;
    std::vector<std::string> labels;
    std::string author, apply;

    /// Returns whether a topic is to be changed.
    [[nodiscard]] bool is_change() const;
};

void add_topic_options(CLI::App& app, TopicArguments& arguments);

/// Makes the changes, all or none.
///
/// Errors      Error{bad_argument}: a change without a topic, a topic without a change, an id that
///             is neither that of a group nor of a clash nor a GUID; as merge_topics and
///             apply_review.
TopicMerge change_topics(const Store& store, const TopicArguments& arguments);

/// Returns a merge as text for the terminal.
std::string merge_text(const TopicMerge& merge);

} // namespace abut::command
