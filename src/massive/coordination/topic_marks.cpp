#include "massive/coordination/topic_marks.h"

#include <abut/clash.h>

#include "massive/coordination/group_rows.h"
#include "massive/record/clash_history.h"
#include "massive/record/clash_marks.h"
#include "massive/record/job_rows.h"

#include <map>
#include <optional>
#include <set>
#include <string>

namespace abut {

namespace {

/// The mark that a status gives to clashes; none if it gives none.
std::optional<ClashStatus> mark_of_status(const std::string& status) {
    if (status == "approved")
        return ClashStatus::approved;
    if (status == "resolved" || status == "closed")
        return ClashStatus::reviewed;
    return std::nullopt;
}

std::string note_of_topic(const Topic& topic) {
    return "topic: " + topic.title;
}

/// The clashes that a topic names and those that its group has now.
std::set<std::uint64_t> clashes_of_topic(Database& database, const Topic& topic) {
    std::set<std::uint64_t> clashes(topic.clashes.begin(), topic.clashes.end());
    if (topic.group.empty())
        return clashes;
    Statement rows(database, "SELECT clash FROM clash_group_member WHERE id = ? AND gone = 0");
    rows.bind(topic.group);
    while (rows.step())
        if (const auto id = parse_clash_id(rows.text(0)))
            clashes.insert(*id);
    return clashes;
}

/// The clashes that exist, and the serial number of the last mark before each came back.
std::map<std::uint64_t, std::int64_t> present_clashes(Database& database) {
    std::map<std::uint64_t, std::int64_t> present;
    for (const QuestionRow& question : read_questions(database))
        for_each_in_history(database, question.question, [&](const HistoryRow& row) {
            if (row.clash.resolved == 0)
                present.emplace(row.clash.id, row.returned);
        });
    return present;
}

} // namespace

std::uint64_t mark_by_topic(Database& database, const Topic& before, const Topic& after,
                            std::int64_t now) {
    if (before.status == after.status)
        return 0;
    const std::optional<ClashStatus> mark = mark_of_status(after.status);
    Marks marks = read_marks(database);
    const auto present = present_clashes(database);
    std::uint64_t marked = 0;
    for (const std::uint64_t clash : clashes_of_topic(database, after)) {
        const auto there = present.find(clash);
        if (there == present.end())
            continue;
        const auto found = marks.find(clash);
        const bool has_mark = found != marks.end() && found->second.serial > there->second;
        const bool is_ours = has_mark && found->second.note == note_of_topic(before);
        if (!mark) {
            if (is_ours)
                remove_mark(database, marks, clash), ++marked;
            continue;
        }
        // What a person said of a single clash is more particular, except that approval of the
        // topic approves all of it.
        if (has_mark && !is_ours && *mark != ClashStatus::approved)
            continue;
        MarkRow row;
        row.id = clash;
        row.mark = *mark;
        row.note = note_of_topic(after);
        row.marked = now;
        put_mark(database, marks, row);
        ++marked;
    }
    return marked;
}

} // namespace abut
