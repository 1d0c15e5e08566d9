#include <abut/clash_review.h>

#include "massive/coordination/coordination_tables.h"
#include "massive/coordination/group_rows.h"
#include "massive/coordination/topic_rows.h"
#include "massive/record/job_counts.h"
#include "massive/record/job_rows.h"
#include "massive/record/job_tables.h"
#include "store/database/store_file.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace abut {

namespace {

/// The job that changes are counted from; 0: from the beginning.
std::int64_t base_job(const GroupMemory& memory, std::optional<std::int64_t> since) {
    std::int64_t base = 0;
    for (const auto& [job, row] : memory.jobs) {
        const bool is_before = since ? row.finished < *since : job != memory.jobs.rbegin()->first;
        if (is_before)
            base = job;
    }
    return base;
}

ListedGroup listed(std::uint64_t id, const GroupRow& row, const GroupMemory& memory) {
    const auto time = [&](std::int64_t job) {
        const auto found = memory.jobs.find(job);
        return found == memory.jobs.end() ? std::int64_t{0} : found->second.finished;
    };
    ListedGroup group;
    group.id = clash_id_text(id);
    group.path = row.path;
    group.name = row.name;
    group.what = row.what;
    group.kind = row.kind;
    group.size = row.size;
    group.centre = row.centre;
    group.appeared = time(row.appeared);
    group.reopened = time(row.reopened);
    group.moved = time(row.moved);
    group.resolved = time(row.resolved);
    return group;
}

GroupReview review_grouping(Database& database, const QuestionRow& question,
                            const GroupingKey& grouping,
                            const std::unordered_map<std::string, Topic>& topics,
                            std::optional<std::int64_t> since) {
    const GroupMemory memory = read_memory(database, grouping);
    GroupReview review;
    review.clearance = question.clearance;
    review.touch_tolerance = question.touch_tolerance();
    review.self = question.self;
    review.rules = question.rules;
    review.by = parse_grouping(grouping.by);
    const std::int64_t base = base_job(memory, since);
    if (const auto job = memory.jobs.find(base); job != memory.jobs.end())
        review.since = job->second.finished;
    if (!memory.jobs.empty())
        review.finished = memory.jobs.rbegin()->second.finished;
    for (const auto& [id, row] : memory.groups) {
        const auto change = row.change_since(base);
        if (!change)
            continue;
        ListedGroup group = listed(id, row, memory);
        group.change = *change;
        ++review.changes.at(static_cast<std::size_t>(*change));
        if (const auto topic = topics.find(group_topic_guid(group.id)); topic != topics.end())
            group.topic = topic->second;
        review.groups.push_back(std::move(group));
    }
    std::ranges::stable_sort(review.groups, [](const ListedGroup& a, const ListedGroup& b) {
        return std::tuple(a.change, b.size) < std::tuple(b.change, a.size);
    });
    for (const auto& [job, counts] : read_counts(database, grouping.question)) {
        review.history.push_back(counts);
        if (const auto row = memory.jobs.find(job); row != memory.jobs.end())
            review.history.back().groups = row->second.changes;
    }
    return review;
}

} // namespace

std::vector<GroupReview> review_groups(const Store& store, std::optional<std::int64_t> since) {
    return store.file().with_connection([&](Database& database) {
        std::vector<GroupReview> result;
        if (!has_coordination_tables(database))
            return result;
        std::unordered_map<std::string, Topic> topics;
        for (Topic& topic : read_topic_rows(database)) {
            const std::string guid = topic.guid;
            topics.emplace(guid, std::move(topic));
        }
        const std::vector<QuestionRow> questions = read_questions(database);
        for (const GroupingKey& grouping : read_groupings(database)) {
            const auto question =
                std::ranges::find(questions, grouping.question, &QuestionRow::question);
            if (question != questions.end())
                result.push_back(review_grouping(database, *question, grouping, topics, since));
        }
        return result;
    });
}

} // namespace abut
