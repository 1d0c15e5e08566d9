#include <abut/store_clash.h>

#include "massive/coordination/coordination_tables.h"
#include "massive/coordination/group_rows.h"
#include "massive/coordination/topic_rows.h"
#include "massive/record/job_counts.h"
#include "massive/record/job_record.h"
#include "massive/record/job_rows.h"
#include "massive/record/job_tables.h"
#include "math/vector.h"
#include "store/database/store_file.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace abut {

namespace {

/// A clash has moved if the middle of its witness points is farther than this from where it was,
/// metres.
constexpr double kMovedBy = 0.01;

std::vector<EarlierGroup> earlier_groups(const GroupMemory& memory) {
    std::vector<EarlierGroup> result;
    std::unordered_map<std::uint64_t, std::size_t> place;
    for (const auto& [id, row] : memory.groups) {
        place.emplace(id, result.size());
        result.push_back(
            {clash_id_text(id), row.parent, row.name, row.kind, row.key, row.centre, {}});
    }
    for (const auto& [clash, row] : memory.members)
        if (const auto found = place.find(row.group); found != place.end())
            result[found->second].clashes.push_back(clash);
    return result;
}

/// The changes of the memory that the grouping of a job's clashes makes.
class MemoryUpdate {
public:
    MemoryUpdate(GroupMemory& memory, std::int64_t job) : memory_(memory), job_(job) {}

    void run(ClashReport& report) {
        take(report, report.groups, {}, {});
        for (auto& [id, row] : memory_.groups)
            if (row.resolved == 0 && !present_.contains(id)) {
                row.resolved = job_;
                row.size = 0;
            }
        for (auto& [clash, row] : memory_.members)
            if (row.gone == 0 && !found_.contains(clash))
                row.gone = job_;
    }

private:
    void take(const ClashReport& report, std::vector<ClashGroup>& groups, const std::string& parent,
              const std::string& path) {
        for (ClashGroup& group : groups)
            if (group.groups.empty())
                take(report, group, parent, path);
            else
                take(report, group.groups, group.id, path + group.name + " / ");
    }

    void take(const ClashReport& report, ClashGroup& group, const std::string& parent,
              const std::string& path) {
        const std::uint64_t id = parse_clash_id(group.id).value_or(0);
        present_.emplace(id, true);
        const auto [entry, is_new] = memory_.groups.try_emplace(id);
        GroupRow& row = entry->second;
        if (is_new)
            row.appeared = job_;
        else if (row.resolved != 0)
            row.reopened = job_;
        row.resolved = 0;
        row.parent = parent;
        row.path = path;
        row.name = group.name;
        row.what = group.what;
        row.kind = group.kind;
        row.key = group.key;
        row.centre = group.centre;
        row.size = group.clashes.size();
        for (const std::uint32_t i : group.clashes)
            if (take_member(report.clashes[i], id))
                row.moved = job_;
    }

    /// Returns whether the clash was in the group and has moved.
    bool take_member(const Clash& clash, std::uint64_t group) {
        const Vec3 point = 0.5 * (clash.point_a + clash.point_b);
        const bool is_first = found_.emplace(clash.id, true).second;
        const auto [entry, is_new] = memory_.members.try_emplace(clash.id);
        MemberRow& row = entry->second;
        const bool was_there = !is_new && row.gone == 0 && row.group == group;
        const bool moved = was_there && is_first && length(row.point - point) > kMovedBy;
        if (!was_there || moved)
            row.point = point;
        row.group = group;
        row.gone = 0;
        return moved;
    }

    GroupMemory& memory_;
    std::int64_t job_;
    std::unordered_map<std::uint64_t, bool> present_, found_;
};

void set_changes(std::vector<ClashGroup>& groups, const GroupMemory& memory, std::int64_t base) {
    for (ClashGroup& group : groups) {
        set_changes(group.groups, memory, base);
        const auto found = memory.groups.find(parse_clash_id(group.id).value_or(0));
        if (group.groups.empty() && found != memory.groups.end())
            group.change = found->second.change_since(base);
    }
}

std::array<std::uint64_t, 5> count_changes(const GroupMemory& memory, std::int64_t base) {
    std::array<std::uint64_t, 5> counts{};
    for (const auto& [id, row] : memory.groups)
        if (const auto change = row.change_since(base))
            ++counts.at(static_cast<std::size_t>(*change));
    return counts;
}

/// Groups the report with the memory of the store, and returns the memory afterwards.
GroupMemory group_with_memory(const GroupMemory& before, StoreClashReport& found,
                              GroupOptions options) {
    options.earlier = earlier_groups(before);
    found.report.groups = group_clashes(found.report, found.models, options);
    found.report.grouping = options.by;
    // A job that is not recorded counts as one after all others.
    const std::int64_t last = before.jobs.empty() ? 0 : before.jobs.rbegin()->first;
    const std::int64_t job = found.job != 0 ? found.job : last + 1;
    GroupMemory after = before;
    if (job > last)
        MemoryUpdate(after, job).run(found.report);
    set_changes(found.report.groups, after, job - 1);
    return after;
}

/// Returns whether the report is that of the last finished job of its question, and the grouping
/// does not have it yet.
bool is_to_be_recorded(Database& database, const StoreClashReport& found,
                       const GroupingKey& grouping) {
    if (found.job == 0 || last_grouping_job(database, grouping) >= found.job)
        return false;
    const auto last = find_finished_job(database, found.question);
    return last && last->job == found.job;
}

void tell_the_rest(Database& database, const GroupMemory& memory, StoreClashReport& found) {
    if (has_job_tables(database) && found.question != 0)
        for (const auto& [job, counts] : read_counts(database, found.question)) {
            found.report.history.push_back(counts);
            if (const auto row = memory.jobs.find(job); row != memory.jobs.end())
                found.report.history.back().groups = row->second.changes;
        }
    if (!has_coordination_tables(database))
        return;
    found.report.topics = read_topic_rows(database);
    found.report.topics_revision = last_revision(database);
}

} // namespace

void group_clashes(const Store& store, StoreClashReport& found, const GroupOptions& options) {
    const GroupingKey grouping{found.question, to_string(options.by)};
    const auto read = [&](Database& database) {
        return found.question != 0 && has_coordination_tables(database)
                   ? read_memory(database, grouping)
                   : GroupMemory();
    };
    const bool records = store.file().with_connection([&](Database& database) {
        return has_job_tables(database) && is_writable_store(store.file().path()) &&
               is_to_be_recorded(database, found, grouping);
    });
    if (!records) {
        store.file().with_connection([&](Database& database) {
            const GroupMemory memory = group_with_memory(read(database), found, options);
            tell_the_rest(database, memory, found);
        });
        return;
    }
    Database database(store.file().path(), OpenMode::read_write);
    database.run("PRAGMA busy_timeout = 10000; PRAGMA synchronous = FULL");
    Transaction transaction(database);
    prepare_coordination_tables(database);
    const GroupMemory before = read(database);
    GroupMemory after = group_with_memory(before, found, options);
    if (is_to_be_recorded(database, found, grouping)) {
        const auto job = find_finished_job(database, found.question);
        after.jobs[found.job] = {job->finished, count_changes(after, found.job - 1)};
        write_memory(database, grouping, before, after);
        transaction.commit();
    }
    tell_the_rest(database, after, found);
}

} // namespace abut
