#pragma once

#include <abut/clash_groups.h>

#include "store/database/sqlite.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

/// Groups of clashes as store rows, each with a checksum. Jobs are named by their numbers, which
/// increase.
namespace abut {

/// A grouping of the clashes of a question.
struct GroupingKey {
    std::int64_t question = 0;
    std::string by; ///< the criteria: "part,place"
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads the comparison
    friend auto operator<=>(const GroupingKey&, const GroupingKey&) = default;
};

/// An innermost group that at least one job found.
struct GroupRow {
    std::string parent; ///< id of the group around it; empty: none
    std::string path;   ///< the names of the groups around it, each followed by " / "
    std::string name, what;
    GroupKind kind = GroupKind::part;
    std::string key;
    Vec3 centre;
    std::uint64_t size = 0;    ///< clashes that the last job found
    std::int64_t appeared = 0; ///< job that found it first
    std::int64_t reopened = 0; ///< last job that found it after it was resolved; 0: none
    std::int64_t moved = 0;    ///< last job that found a clash of it elsewhere; 0: none
    std::int64_t resolved = 0; ///< job that found none of its clashes any more; 0: it has some

    /// Its fate after job `base`; none if it was resolved before.
    [[nodiscard]] std::optional<GroupChange> change_since(std::int64_t base) const;
};

/// A clash that was in a group when a job last found it.
struct MemberRow {
    std::uint64_t group = 0; ///< its id as a number
    Vec3 point;              ///< where it was when it last moved
    std::int64_t gone = 0;   ///< job that found it gone; 0: it is there
};

/// A job whose clashes were grouped, with the numbers of groups of each GroupChange since the job
/// before.
struct GroupingJob {
    std::int64_t finished = 0;
    std::array<std::uint64_t, 5> changes{};
};

/// All rows of one grouping.
struct GroupMemory {
    std::map<std::uint64_t, GroupRow> groups;             ///< by id
    std::unordered_map<std::uint64_t, MemberRow> members; ///< by clash id
    std::map<std::int64_t, GroupingJob> jobs;             ///< by number
};

/// Returns the groupings that a store has, in order.
std::vector<GroupingKey> read_groupings(Database& database);

/// Returns the last job whose clashes were grouped so; 0 if there is none or no such table.
std::int64_t last_grouping_job(Database& database, const GroupingKey& grouping);

/// Errors      Error{malformed}, naming the store, if a row does not match its checksum or is
///             missing.
GroupMemory read_memory(Database& database, const GroupingKey& grouping);

/// Writes the rows of `after` that differ from those of `before`, which the store has. The caller
/// holds a transaction.
void write_memory(Database& database, const GroupingKey& grouping, const GroupMemory& before,
                  const GroupMemory& after);

} // namespace abut
