#pragma once

#include "store/sqlite.h"

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

/// The tables of jobs in a store; docs/massive.md says what their columns mean.
namespace abut {

/// Makes the tables that are missing. Those of jobs that the first version made are made anew, empty:
/// jobs can be done again. What people said of clashes stays. Within a transaction.
void prepare_job_tables(Database& database);
/// Whether there are all tables.
/// Errors      of both: Error{malformed}, naming the store, if there is another table of such a name.
bool has_job_tables(Database& database);

/// How many rows a list has, and the sum of their checksums: a row that a damaged page hides is missed.
struct RowTally {
    std::uint64_t rows = 0, sum = 0;
    void add(std::uint64_t checksum) { ++rows, sum += checksum; }
    void remove(std::uint64_t checksum) { --rows, sum -= checksum; }
    friend bool operator==(const RowTally&, const RowTally&) = default;
};
/// The tally of a list as it was kept; of none if there is no such list.
RowTally read_tally(Database& database, const std::string& list);
void write_tally(Database& database, const std::string& list, const RowTally& tally);
/// Errors      Error{malformed}, naming the store, if rows are missing.
void require_tally(Database& database, const std::string& list, const RowTally& found);

/// The elements of a blob; none if its size is no multiple of theirs.
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

[[noreturn]] void damaged_job(const Database& database, const std::string& what);

} // namespace abut
