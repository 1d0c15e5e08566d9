#include "massive/coordination/group_rows.h"

#include <abut/clash.h>

#include "massive/record/job_tables.h"
#include "store/database/row_hash.h"

#include <algorithm>
#include <optional>

namespace abut {

namespace {

constexpr std::array kGroupKinds{GroupKind::part,      GroupKind::copies, GroupKind::place,
                                 GroupKind::storey,    GroupKind::system, GroupKind::types,
                                 GroupKind::discipline};

std::optional<GroupKind> group_kind_of_text(const std::string& text) {
    const auto* const found =
        std::ranges::find_if(kGroupKinds, [&](GroupKind kind) { return text == to_string(kind); });
    return found == kGroupKinds.end() ? std::nullopt : std::optional(*found);
}

std::string tally_name(const char* table, const GroupingKey& grouping) {
    return std::string(table) + " " + std::to_string(grouping.question) + " " + grouping.by;
}

RowHash& add_stored(RowHash& hash, const Vec3& p) {
    return hash.add(p.x + 0.0).add(p.y + 0.0).add(p.z + 0.0); // SQLite keeps no sign of zero
}

std::uint64_t row_checksum(const GroupingKey& grouping, std::uint64_t id, const GroupRow& row) {
    RowHash hash;
    hash.add(grouping.question).add(grouping.by).add(id).add(row.parent).add(row.path);
    hash.add(row.name).add(row.what).add(row.kind).add(row.key).add(row.size);
    add_stored(hash, row.centre);
    return hash.add(row.appeared).add(row.reopened).add(row.moved).add(row.resolved).value();
}

std::uint64_t row_checksum(const GroupingKey& grouping, std::uint64_t clash, const MemberRow& row) {
    RowHash hash;
    hash.add(grouping.question).add(grouping.by).add(clash).add(row.group).add(row.gone);
    return add_stored(hash, row.point).value();
}

std::uint64_t row_checksum(const GroupingKey& grouping, std::int64_t job, const GroupingJob& row) {
    RowHash hash;
    hash.add(grouping.question).add(grouping.by).add(job).add(row.finished);
    for (const std::uint64_t number : row.changes)
        hash.add(number);
    return hash.value();
}

[[noreturn]] void refuse_row(const Database& database, const char* table, const std::string& id) {
    damaged_job(database, std::string(table) + " " + id + " does not match its checksum");
}

void read_groups(Database& database, const GroupingKey& grouping, GroupMemory& memory) {
    RowTally tally;
    Statement rows(database,
                   "SELECT id, parent, path, name, what, kind, key, x, y, z, size, appeared, "
                   "reopened, moved, resolved, checksum FROM clash_group WHERE question = ? AND "
                   "grouping = ?");
    rows.bind(grouping.question, grouping.by);
    while (rows.step()) {
        const auto id = parse_clash_id(rows.text(0));
        const auto kind = group_kind_of_text(rows.text(5));
        const GroupRow row{rows.text(1),
                           rows.text(2),
                           rows.text(3),
                           rows.text(4),
                           kind.value_or(GroupKind::part),
                           rows.text(6),
                           {rows.real(7), rows.real(8), rows.real(9)},
                           static_cast<std::uint64_t>(rows.integer(10)),
                           rows.integer(11),
                           rows.integer(12),
                           rows.integer(13),
                           rows.integer(14)};
        const auto checksum = static_cast<std::uint64_t>(rows.integer(15));
        if (!id || !kind || row_checksum(grouping, *id, row) != checksum)
            refuse_row(database, "clash_group", rows.text(0));
        tally.add(checksum);
        memory.groups.emplace(*id, row);
    }
    require_tally(database, tally_name("clash_group", grouping), tally);
}

void read_members(Database& database, const GroupingKey& grouping, GroupMemory& memory) {
    RowTally tally;
    Statement rows(database, "SELECT clash, id, x, y, z, gone, checksum FROM clash_group_member "
                             "WHERE question = ? AND grouping = ?");
    rows.bind(grouping.question, grouping.by);
    while (rows.step()) {
        const auto clash = parse_clash_id(rows.text(0)), group = parse_clash_id(rows.text(1));
        const MemberRow row{
            group.value_or(0), {rows.real(2), rows.real(3), rows.real(4)}, rows.integer(5)};
        const auto checksum = static_cast<std::uint64_t>(rows.integer(6));
        if (!clash || !group || row_checksum(grouping, *clash, row) != checksum)
            refuse_row(database, "clash_group_member", rows.text(0));
        tally.add(checksum);
        memory.members.emplace(*clash, row);
    }
    require_tally(database, tally_name("clash_group_member", grouping), tally);
}

void read_grouping_jobs(Database& database, const GroupingKey& grouping, GroupMemory& memory) {
    RowTally tally;
    Statement rows(database, "SELECT job, finished, new, active, moved, reopened, resolved, "
                             "checksum FROM clash_grouping WHERE question = ? AND grouping = ?");
    rows.bind(grouping.question, grouping.by);
    while (rows.step()) {
        GroupingJob row{rows.integer(1), {}};
        for (std::size_t i = 0; i < row.changes.size(); ++i)
            row.changes.at(i) = static_cast<std::uint64_t>(rows.integer(static_cast<int>(i) + 2));
        const auto checksum = static_cast<std::uint64_t>(rows.integer(7));
        if (row_checksum(grouping, rows.integer(0), row) != checksum)
            refuse_row(database, "clash_grouping", rows.text(0));
        tally.add(checksum);
        memory.jobs.emplace(rows.integer(0), row);
    }
    require_tally(database, tally_name("clash_grouping", grouping), tally);
}

/// Calls put(id, row) for each row of `after` that `before` has not, and remove(id) for each row
/// that only `before` has; updates the tally of the table.
template <typename Rows, typename Put, typename Remove>
void write_differences(Database& database, const char* table, const GroupingKey& grouping,
                       const Rows& before, const Rows& after, const Put& put,
                       const Remove& remove) {
    const std::string list = tally_name(table, grouping);
    RowTally tally = read_tally(database, list);
    for (const auto& [id, row] : before)
        if (!after.contains(id)) {
            tally.remove(row_checksum(grouping, id, row));
            remove(id);
        }
    for (const auto& [id, row] : after) {
        const std::uint64_t checksum = row_checksum(grouping, id, row);
        const auto old = before.find(id);
        if (old != before.end()) {
            const std::uint64_t earlier = row_checksum(grouping, id, old->second);
            if (earlier == checksum)
                continue;
            tally.remove(earlier);
        }
        tally.add(checksum);
        put(id, row, checksum);
    }
    write_tally(database, list, tally);
}

} // namespace

std::optional<GroupChange> GroupRow::change_since(std::int64_t base) const {
    if (resolved != 0)
        return resolved > base && appeared <= base ? std::optional(GroupChange::resolved)
                                                   : std::nullopt;
    if (appeared > base)
        return GroupChange::fresh;
    if (reopened > base)
        return GroupChange::reopened;
    return moved > base ? GroupChange::moved : GroupChange::active;
}

std::vector<GroupingKey> read_groupings(Database& database) {
    std::vector<GroupingKey> result;
    // Groupings that have lost rows are included: read_memory reports them.
    Statement rows(database, "SELECT question, grouping FROM clash_grouping "
                             "UNION SELECT question, grouping FROM clash_group "
                             "ORDER BY question, grouping");
    while (rows.step())
        result.push_back({rows.integer(0), rows.text(1)});
    return result;
}

std::int64_t last_grouping_job(Database& database, const GroupingKey& grouping) {
    if (database.number("SELECT count(*) FROM sqlite_schema WHERE name = 'clash_grouping'") == 0)
        return 0;
    Statement last(database, "SELECT coalesce(max(job), 0) FROM clash_grouping "
                             "WHERE question = ? AND grouping = ?");
    last.bind(grouping.question, grouping.by);
    return last.step() ? last.integer(0) : 0;
}

GroupMemory read_memory(Database& database, const GroupingKey& grouping) {
    GroupMemory memory;
    read_groups(database, grouping, memory);
    read_members(database, grouping, memory);
    read_grouping_jobs(database, grouping, memory);
    return memory;
}

void write_memory(Database& database, const GroupingKey& grouping, const GroupMemory& before,
                  const GroupMemory& after) {
    const auto [question, by] = grouping;
    const auto remove_from = [&](const char* table, const char* column) {
        return [&, sql = std::string("DELETE FROM ") + table +
                         " WHERE question = ? AND grouping = ? AND " + column +
                         " = ?"](std::uint64_t id) {
            Statement(database, sql).bind(grouping.question, grouping.by, clash_id_text(id)).run();
        };
    };
    Statement group(database, "INSERT OR REPLACE INTO clash_group VALUES "
                              "(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
    write_differences(
        database, "clash_group", grouping, before.groups, after.groups,
        [&](std::uint64_t id, const GroupRow& row, std::uint64_t checksum) {
            const std::string text = clash_id_text(id);
            group
                .bind(grouping.question, grouping.by, text, row.parent, row.path, row.name,
                      row.what, std::string_view(to_string(row.kind)), row.key, row.centre.x,
                      row.centre.y, row.centre.z, row.size, row.appeared, row.reopened, row.moved,
                      row.resolved, checksum)
                .run();
        },
        remove_from("clash_group", "id"));
    Statement member(database,
                     "INSERT OR REPLACE INTO clash_group_member VALUES (?,?,?,?,?,?,?,?,?)");
    write_differences(
        database, "clash_group_member", grouping, before.members, after.members,
        [&](std::uint64_t id, const MemberRow& row, std::uint64_t checksum) {
            const std::string clash = clash_id_text(id), in = clash_id_text(row.group);
            member
                .bind(grouping.question, grouping.by, clash, in, row.point.x, row.point.y,
                      row.point.z, row.gone, checksum)
                .run();
        },
        remove_from("clash_group_member", "clash"));
    Statement job(database, "INSERT OR REPLACE INTO clash_grouping VALUES (?,?,?,?,?,?,?,?,?,?)");
    write_differences(
        database, "clash_grouping", grouping, before.jobs, after.jobs,
        [&](std::int64_t number, const GroupingJob& row, std::uint64_t checksum) {
            const auto& n = row.changes;
            job.bind(grouping.question, grouping.by, number, row.finished, n[0], n[1], n[2], n[3],
                     n[4], checksum)
                .run();
        },
        [](std::int64_t) {});
}

} // namespace abut
