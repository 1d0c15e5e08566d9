#pragma once

#include <abut/clash.h>

#include "store/sqlite.h"

#include <cstdint>
#include <string>
#include <unordered_map>

namespace abut {

/// What someone has said of a clash, whichever question it answers. Rows of a store, with checksums.
struct MarkRow {
    std::int64_t serial = 0; ///< counts all marks that were ever set; put_mark gives it
    std::uint64_t id = 0;
    ClashStatus mark = ClashStatus::reviewed; ///< or approved
    std::string note;
    std::int64_t marked = 0; ///< when, in seconds since 1970

    [[nodiscard]] std::uint64_t checksum() const;
};

using Marks = std::unordered_map<std::uint64_t, MarkRow>;

/// The serial number of the last mark that was set.
std::int64_t last_mark(Database& database);

/// Errors      Error{malformed}, naming the store, if a row is not what its checksum says, or missing.
Marks read_marks(Database& database);

/// Sets a mark in place of what `marks` has, or takes it away. Within a transaction.
void put_mark(Database& database, Marks& marks, MarkRow row);
void remove_mark(Database& database, Marks& marks, std::uint64_t id);

} // namespace abut
