#include <abut/clash_review.h>
#include <abut/error.h>

#include "massive/coordination/coordination_tables.h"
#include "massive/coordination/group_rows.h"
#include "massive/coordination/topic_rows.h"
#include "massive/record/clash_history.h"
#include "massive/record/clash_marks.h"
#include "massive/record/job_counts.h"
#include "massive/record/job_rows.h"
#include "massive/record/job_tables.h"
#include "massive/record/question_terms.h"
#include "massive/record/work_rows.h"
#include "store/database/store_file.h"

#include <algorithm>
#include <ctime>
#include <optional>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace abut {

namespace {

[[noreturn]] void refuse(const Database& database, std::uint64_t id, const char* why) {
    throw Error(ErrorCode::bad_argument, database.path(), "clash " + clash_id_text(id) + why);
}

/// The ids of all clashes in the history; those of the clashes that are not resolved.
struct KnownIds {
    std::unordered_set<std::uint64_t> known, present;
};

KnownIds known_ids(Database& database) {
    KnownIds ids;
    for (const QuestionRow& question : read_questions(database))
        for_each_in_history(database, question.question, [&](const HistoryRow& row) {
            ids.known.insert(row.clash.id);
            if (row.clash.resolved == 0)
                ids.present.insert(row.clash.id);
        });
    return ids;
}

void require_applicable(const Database& database, const MarkChanges& changes, const KnownIds& ids) {
    std::unordered_set<std::uint64_t> seen;
    for (const auto* list : {&changes.reviewed, &changes.approved, &changes.cleared})
        for (const std::uint64_t id : *list) {
            if (!ids.known.contains(id))
                refuse(database, id, " is not in the store: no job that ended has found it");
            if (list != &changes.cleared && !ids.present.contains(id))
                refuse(database, id, " is resolved: there is nothing to mark");
            if (!seen.insert(id).second)
                refuse(database, id, " is named twice");
        }
}

ClashReview review(Database& database, const QuestionRow& question, const Marks& marks) {
    ClashReview result{
        question.clearance, question.touch_tolerance(), question.self, question.rules, 0, {}, {}};
    const auto job = find_finished_job(database, question.question);
    result.finished = job ? job->finished : 0;
    for_each_in_history(database, question.question, [&](HistoryRow&& row) {
        const auto found = marks.find(row.clash.id);
        const MarkRow* mark = found == marks.end() ? nullptr : &found->second;
        row.clash.status = row.status(mark, job ? job->job : 0);
        if (mark != nullptr && row.clash.status == mark->mark)
            row.clash.note = mark->note;
        ++result.statuses.at(static_cast<std::size_t>(row.clash.status));
        result.clashes.push_back(std::move(row.clash));
    });
    // The rows come sorted by id, and the stable sort keeps that order among equals.
    std::ranges::stable_sort(result.clashes, [](const ListedClash& a, const ListedClash& b) {
        return std::tie(a.status, a.distance) < std::tie(b.status, b.distance);
    });
    return result;
}

/// Removes clashes that no history knows from all groups, and resolved groups that are left without
/// any, unless people have said something about them.
void forget_members(Database& database, const std::unordered_set<std::uint64_t>& known) {
    std::unordered_set<std::string> with_topic;
    for (const Topic& topic : read_topic_rows(database))
        with_topic.insert(topic.group);
    for (const GroupingKey& grouping : read_groupings(database)) {
        const GroupMemory before = read_memory(database, grouping);
        GroupMemory after = before;
        std::erase_if(after.members, [&](const auto& row) { return !known.contains(row.first); });
        std::unordered_set<std::uint64_t> used;
        for (const auto& [clash, row] : after.members)
            used.insert(row.group);
        std::erase_if(after.groups, [&](const auto& row) {
            return row.second.resolved != 0 && !used.contains(row.first) &&
                   !with_topic.contains(clash_id_text(row.first));
        });
        write_memory(database, grouping, before, after);
    }
}

} // namespace

std::vector<ClashReview> review_clashes(const Store& store) {
    return store.file().with_connection([](Database& database) {
        std::vector<ClashReview> result;
        if (!has_job_tables(database))
            return result;
        const Marks marks = read_marks(database);
        for (const QuestionRow& question : read_questions(database))
            result.push_back(review(database, question, marks));
        return result;
    });
}

void mark_clashes(const Store& store, const MarkChanges& changes) {
    store.file().with_connection([&](Database& database) {
        Transaction transaction(database);
        prepare_job_tables(database);
        require_applicable(database, changes, known_ids(database));
        Marks marks = read_marks(database);
        MarkRow mark;
        mark.note = changes.note;
        mark.marked = static_cast<std::int64_t>(std::time(nullptr));
        for (const auto& [list, status] : {std::pair(&changes.reviewed, ClashStatus::reviewed),
                                           std::pair(&changes.approved, ClashStatus::approved)})
            for (const std::uint64_t id : *list) {
                mark.id = id;
                mark.mark = status;
                put_mark(database, marks, mark);
            }
        for (const std::uint64_t id : changes.cleared)
            remove_mark(database, marks, id);
        transaction.commit();
    });
}

std::uint64_t forget_resolved_clashes(const Store& store) {
    return store.file().with_connection([](Database& database) {
        Transaction transaction(database);
        prepare_coordination_tables(database);
        std::vector<std::uint64_t> gone;
        for (const QuestionRow& question : read_questions(database))
            for (const std::uint64_t id : forget_resolved(database, question.question))
                gone.push_back(id);
        Marks marks = read_marks(database);
        const KnownIds ids = known_ids(database);
        for (const std::uint64_t id : gone)
            if (!ids.known.contains(id)) // another question may still have it
                remove_mark(database, marks, id);
        forget_members(database, ids.known);
        transaction.commit();
        return std::uint64_t{gone.size()};
    });
}

ClashOptions last_clash_options(const Store& store) {
    return store.file().with_connection([](Database& database) {
        std::optional<JobRow> last;
        if (has_job_tables(database))
            for (JobRow& job : read_jobs(database))
                // A job that was interrupted may finish after a job that began later.
                if (job.finished != 0 && (!last || job.finished >= last->finished))
                    last = std::move(job);
        if (!last)
            throw Error(ErrorCode::bad_argument, database.path(), "no clash job has finished");
        return read_terms(database, last->question);
    });
}

void verify_jobs(const Store& store) {
    store.file().with_connection([](Database& database) {
        if (!has_job_tables(database))
            return;
        (void)read_marks(database);
        for (const QuestionRow& question : read_questions(database)) {
            for_each_in_history(database, question.question, [](const HistoryRow&) {});
            (void)read_counts(database, question.question);
        }
        verify_terms(database);
        for (const JobRow& job : read_jobs(database)) {
            for_each_clash(database, job.job, [](const ClashRow&) {});
            for_each_pair_left(database, job.job, [](const RowPair&) {});
        }
        if (!has_coordination_tables(database))
            return;
        for (const GroupingKey& grouping : read_groupings(database))
            (void)read_memory(database, grouping);
        verify_topics(database);
    });
}

} // namespace abut
