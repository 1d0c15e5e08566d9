#pragma once

#include <abut/clash.h>

#include "store/sqlite.h"

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

/// What jobs have found, and what is left to do: rows of a store, each with its checksum. What writes
/// is called within a transaction.
///
/// Errors      of all readers: Error{malformed}, naming the store, if a row is not what its checksum
///             says, or missing.
namespace abut {

/// Two parts by their rows in the store, a and b.
using RowPair = std::pair<std::int64_t, std::int64_t>;

/// A clash of a job: `clash` without model and part.
struct ClashRow {
    RowPair parts;
    Clash clash;
};
void add_clashes(Database& database, std::int64_t job, const std::vector<ClashRow>& clashes);
void for_each_clash(Database& database, std::int64_t job,
                    const std::function<void(ClashRow&&)>& take);

/// The pairs of a piece of work that is left to do.
void add_units(Database& database, std::int64_t job,
               const std::vector<std::vector<RowPair>>& units);
void remove_unit(Database& database, std::int64_t job, std::uint64_t unit);
/// All that is left, and with clashes all that was found.
void remove_units(Database& database, std::int64_t job);
void remove_work(Database& database, std::int64_t job);
void for_each_pair_left(Database& database, std::int64_t job,
                        const std::function<void(const RowPair&)>& take);

} // namespace abut
