#pragma once

#include "store/database/sqlite.h"

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The tables of jobs in a store. docs/massive.md explains the columns.
namespace abut {

/// A table or a view and the statement that makes it. SQLite stores the statement verbatim.
struct StoreTable {
    std::string_view name;
    const char* sql;
};
/// Returns whether the table exists.
/// Errors      Error{malformed}, naming the store, if there is a foreign table of this name.
bool has_table(Database& database, const StoreTable& table);

/// Creates the tables that are missing. Job tables of an earlier version are replaced by empty ones,
/// because jobs can be run again. The marks of users stay. The caller holds a transaction.
void prepare_job_tables(Database& database);
/// Returns whether all tables exist.
/// Errors      of both functions: Error{malformed}, naming the store, if it has a foreign table of
///             such a name.
bool has_job_tables(Database& database);

/// The number of rows of a list and the sum of their checksums. It reveals a row that a damaged
/// page hides.
struct RowTally {
    std::uint64_t rows = 0, sum = 0;
    void add(std::uint64_t checksum) { ++rows, sum += checksum; }
    void remove(std::uint64_t checksum) { --rows, sum -= checksum; }
    friend bool operator==(const RowTally&, const RowTally&) = default;
};
/// Returns the stored tally of a list; an empty tally if there is no such list.
RowTally read_tally(Database& database, const std::string& list);
void write_tally(Database& database, const std::string& list, const RowTally& tally);
/// Errors      Error{malformed}, naming the store, if rows are missing.
void require_tally(Database& database, const std::string& list, const RowTally& found);

/// Returns the elements of a blob; none if its size is not a multiple of the element size.
template <typename Element>
std::vector<Element> blob_elements(std::span<const std::byte> bytes) {
    std::vector<Element> result;
    if (bytes.size() % sizeof(Element) != 0)
        return result;
    result.resize(bytes.size() / sizeof(Element));
    if (!bytes.empty())
        std::memcpy(result.data(), bytes.data(), bytes.size());
    return result;
}

/// The time in seconds since 1970, as tables hold it.
std::int64_t now();

/// Throws Error{malformed}, naming the store.
[[noreturn]] void damaged_job(const Database& database, const std::string& what);

} // namespace abut
