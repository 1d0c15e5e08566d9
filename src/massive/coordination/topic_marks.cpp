#include "massive/coordination/topic_marks.h"

#include <abut/clash.h>

#include "massive/record/clash_history.h"
#include "massive/record/job_rows.h"

#include <algorithm>
#include <optional>

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

} // namespace

void TopicMarks::read_once() {
    if (is_read_)
        return;
    is_read_ = true;
    marks_ = read_marks(database_);
    for (const QuestionRow& question : read_questions(database_))
        for_each_in_history(database_, question.question, [&](const HistoryRow& row) {
            if (row.clash.resolved != 0)
                return;
            const auto there =
                present_.try_emplace(row.clash.id, Returned{row.returned, row.returned}).first;
            there->second.largest = std::max(there->second.largest, row.returned);
        });
    Statement rows(database_, "SELECT id, clash FROM clash_group_member WHERE gone = 0");
    while (rows.step())
        if (const auto clash = parse_clash_id(rows.text(1)))
            members_[rows.text(0)].push_back(*clash);
}

/// The clashes that a topic names and those that its group has now, each once, ascending.
std::vector<std::uint64_t> TopicMarks::clashes_of(const Topic& topic) const {
    std::vector<std::uint64_t> clashes = topic.clashes;
    const auto members = members_.find(topic.group);
    if (members != members_.end())
        clashes.insert(clashes.end(), members->second.begin(), members->second.end());
    std::ranges::sort(clashes);
    clashes.erase(std::unique(clashes.begin(), clashes.end()), clashes.end());
    return clashes;
}

std::uint64_t TopicMarks::change(const Topic& before, const Topic& after, std::int64_t now) {
    const std::optional<ClashStatus> mark = mark_of_status(after.status);
    // A mark is recognized by its note, which therefore follows the title.
    const bool is_renamed_only = before.status == after.status;
    if (is_renamed_only && (before.title == after.title || !mark))
        return 0;
    read_once();
    std::uint64_t marked = 0;
    for (const std::uint64_t clash : clashes_of(after)) {
        const auto there = present_.find(clash);
        if (there == present_.end())
            continue;
        const auto found = marks_.find(clash);
        const bool has_mark = found != marks_.end() && found->second.serial > there->second.first;
        const bool is_ours = has_mark && found->second.note == note_of_topic(before);
        if (is_renamed_only) {
            // The mark gets a new serial number. That must not renew it where it is void.
            if (is_ours && found->second.serial > there->second.largest) {
                MarkRow row = found->second;
                row.note = note_of_topic(after);
                put_mark(database_, marks_, row);
            }
            continue;
        }
        if (!mark) {
            if (is_ours)
                remove_mark(database_, marks_, clash), ++marked;
            continue;
        }
        // A mark that a person set on a single clash is more particular, except that approval of
        // the topic approves all of it.
        if (has_mark && !is_ours && *mark != ClashStatus::approved)
            continue;
        MarkRow row;
        row.id = clash;
        row.mark = *mark;
        row.note = note_of_topic(after);
        row.marked = now;
        put_mark(database_, marks_, row);
        ++marked;
    }
    return marked;
}

} // namespace abut
