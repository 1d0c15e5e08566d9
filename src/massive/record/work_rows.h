#pragma once

#include <abut/clash.h>

#include "store/database/sqlite.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

/// The clashes that jobs have found and the work units that are left, as store rows with checksums.
/// The caller of a function that writes holds a transaction.
///
/// Errors      of all functions that read: Error{malformed}, naming the store, if a row does not
///             match its checksum or is missing.
namespace abut {

/// The store rows of parts a and b.
using RowPair = std::pair<std::int64_t, std::int64_t>;

/// A clash of a job, and why the report does not have it if it does not.
struct FoundClash {
    Clash clash;
    std::optional<LeftOut> left_out{};
};

/// A clash of a job as a row. `clash` has no model and part; `parts` stands for them.
struct ClashRow {
    RowPair parts;
    Clash clash;
    std::optional<LeftOut> left_out{};
};
void add_clashes(Database& database, std::int64_t job, const std::vector<ClashRow>& clashes);
void for_each_clash(Database& database, std::int64_t job,
                    const std::function<void(ClashRow&&)>& take);

/// Adds the work units that are left to do, each as its list of pairs.
void add_units(Database& database, std::int64_t job,
               const std::vector<std::vector<RowPair>>& units);
void remove_unit(Database& database, std::int64_t job, std::uint64_t unit);
/// remove_units removes the units of a job; remove_work removes its units and its clashes.
void remove_units(Database& database, std::int64_t job);
void remove_work(Database& database, std::int64_t job);
void for_each_pair_left(Database& database, std::int64_t job,
                        const std::function<void(const RowPair&)>& take);

} // namespace abut
