#include "verbs/review_topics.h"

#include <abut/clash.h>
#include <abut/error.h>

#include "arguments/common.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace abut::command {

namespace {

/// The topics of a store by GUID, and those of its groups and clashes of which nobody has said
/// anything.
std::map<std::string, Topic> known_topics(const Store& store) {
    std::map<std::string, Topic> known;
    for (const Topic& topic : untouched_topics(store))
        known.emplace(topic.guid, topic);
    for (const Topic& topic : read_topics(store))
        known.insert_or_assign(topic.guid, topic);
    return known;
}

/// Finds the topic that an id of a group or a clash, or a GUID, names.
const Topic& find_topic(const std::map<std::string, Topic>& known, const std::string& id) {
    auto found = known.find(id);
    if (const auto number = parse_clash_id(id)) {
        found = known.find(group_topic_guid(id));
        if (found == known.end())
            found = known.find(clash_topic_guid(*number));
    }
    if (found == known.end())
        throw Error(ErrorCode::bad_argument, "--topic",
                    "'" + id +
                        "' is not the id of a group or a clash of the store, nor the GUID of one "
                        "of its topics");
    return found->second;
}

bool has_edit(const TopicArguments& a) {
    return a.assignee || a.due || a.comment || a.status || a.priority || a.title ||
           !a.labels.empty();
}

} // namespace

bool TopicArguments::is_change() const {
    return !topics.empty() || has_edit(*this) || !apply.empty();
}

void add_topic_options(CLI::App& app, TopicArguments& a) {
    const auto add = [&](const char* name, auto& value, const char* type, const char* what) {
        return app.add_option(name, value, what)->type_name(type);
    };
    add("--topic", a.topics, "ID", "Topics to change: ids of groups or clashes, or GUIDs of topics")
        ->check(not_empty("ID"));
    add("--assign", a.assignee, "NAME", "Set who is to act; an empty name: nobody");
    add("--due", a.due, "DATE", "Set the due date, YYYY-MM-DD; empty: none");
    add("--comment", a.comment, "TEXT", "Add a comment")->check(not_empty("TEXT"));
    add("--set-status", a.status, "WORD",
        "Set the status: open, assigned, resolved, closed, approved, or another word; approved "
        "approves the clashes")
        ->check(not_empty("WORD"));
    add("--priority", a.priority, "WORD", "Set the priority");
    add("--title", a.title, "TEXT", "Set the title")->check(not_empty("TEXT"));
    add("--label", a.labels, "WORD", "Add labels; one with a minus sign in front is removed")
        ->check(not_empty("WORD"));
    add("--by", a.author, "NAME", "Who makes the changes")->check(not_empty("NAME"));
    add("--apply", a.apply, "FILE", "Merge the edits that a report page has saved")
        ->check(not_empty("FILE"));
}

TopicMerge change_topics(const Store& store, const TopicArguments& a) {
    if (!a.apply.empty()) {
        if (!a.topics.empty() || has_edit(a))
            throw Error(ErrorCode::bad_argument, "--apply", "goes with --by alone");
        return apply_review(store, a.apply, {.base = {}, .author = a.author, .now = 0});
    }
    if (a.topics.empty())
        throw Error(ErrorCode::bad_argument, "--topic", "is missing: which topics are to change?");
    if (!has_edit(a))
        throw Error(ErrorCode::bad_argument, "--topic",
                    "needs a change: --assign, --due, --comment, --set-status, --priority, "
                    "--title or --label");
    // Named, so that what others change from here on is not taken back.
    const std::int64_t base = topics_revision(store);
    const std::map<std::string, Topic> known = known_topics(store);
    std::vector<Topic> edited;
    for (const std::string& id : a.topics) {
        Topic topic = find_topic(known, id);
        topic.modified_by = a.author; // not who changed it before
        topic.assignee = a.assignee.value_or(topic.assignee);
        topic.due = a.due.value_or(topic.due);
        topic.status = a.status.value_or(topic.status);
        topic.priority = a.priority.value_or(topic.priority);
        topic.title = a.title.value_or(topic.title);
        for (const std::string& label : a.labels)
            if (label.front() == '-')
                std::erase(topic.labels, label.substr(1));
            else if (std::ranges::find(topic.labels, label) == topic.labels.end())
                topic.labels.push_back(label);
        if (a.comment)
            topic.comments.push_back({{}, a.author, *a.comment, 0, {}});
        edited.push_back(std::move(topic));
    }
    return merge_topics(store, edited, {.base = base, .author = a.author, .now = 0});
}

std::string merge_text(const TopicMerge& merge) {
    std::string text = fmt::format(
        "revision {}: {} topics added, {} changed, {} comments, {} clashes marked\n",
        merge.revision, merge.added.size(), merge.changed.size(), merge.comments, merge.marked);
    for (const TopicConflict& conflict : merge.conflicts)
        text += fmt::format("conflict: {}: {} stays \"{}\"; \"{}\" is kept in a comment\n",
                            shown(conflict.title.empty() ? conflict.guid : conflict.title),
                            conflict.field, shown(conflict.stored), shown(conflict.edited));
    for (const std::string& warning : merge.warnings)
        text += fmt::format("warning: {}\n", shown(warning));
    return text;
}

} // namespace abut::command
