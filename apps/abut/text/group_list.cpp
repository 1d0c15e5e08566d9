#include "text/group_list.h"

#include "arguments/common.h"
#include "text/clash_summary.h"

#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>

namespace abut::command {

namespace {

std::string minute(std::int64_t time) {
    return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(static_cast<std::time_t>(time)));
}

/// Status, assignee and due date of a topic, and its last comment.
std::string topic_line(const Topic& topic) {
    std::string text = fmt::format("             {}", shown(topic.status));
    if (!topic.assignee.empty())
        text += ", " + shown(topic.assignee);
    if (!topic.due.empty())
        text += ", due " + shown(topic.due);
    if (!topic.priority.empty())
        text += ", " + shown(topic.priority);
    for (const std::string& label : topic.labels)
        text += " #" + shown(label);
    if (!topic.comments.empty()) {
        const TopicComment& last = topic.comments.back();
        text += fmt::format(", {} comment{}: {}{}\"{}\"", topic.comments.size(),
                            topic.comments.size() == 1 ? "" : "s", shown(last.author),
                            last.author.empty() ? "" : ": ", shown(last.text));
    }
    return text + "\n";
}

std::string group_row(const ListedGroup& group) {
    std::string text =
        fmt::format("  {}  {:<8} {:>6}  {}{}", group.id, abut::to_string(group.change),
                    grouped(group.size), shown(group.path), shown(group.name));
    if (group.change == GroupChange::resolved)
        text += fmt::format("  [since {}]", minute(group.resolved));
    else if (!group.what.empty())
        text += ": " + shown(group.what);
    text += "\n";
    if (group.topic)
        text += topic_line(*group.topic);
    return text;
}

} // namespace

std::string group_list(const GroupReview& review) {
    std::string text =
        fmt::format("clearance {}, touch {}{}{}, groups by {}\n", metres(review.clearance),
                    touch_in_words(review.touch_tolerance), review.self ? ", self" : "",
                    review.rules == 0 ? "" : fmt::format(", {} rules", review.rules),
                    abut::to_string(review.by));
    for (const GroupChange change : kGroupChanges)
        text += fmt::format("{}{} {}", change == GroupChange::fresh ? "  " : ", ",
                            abut::to_string(change),
                            grouped(review.changes.at(static_cast<std::size_t>(change))));
    text += review.since == 0 ? " since the first job\n"
                              : fmt::format(" since the job of {}\n", minute(review.since));
    for (const ListedGroup& group : review.groups)
        text += group_row(group);
    return text;
}

} // namespace abut::command
