#pragma once

#include <abut/clash.h>

#include "store/database/sqlite.h"

#include <cstdint>
#include <string>
#include <unordered_map>

namespace abut {

/// A user's mark on a clash: reviewed or approved, with a note. It applies to the clash in every
/// question. It is a store row with a checksum.
struct MarkRow {
    std::int64_t serial = 0; ///< number among all marks ever set; put_mark assigns it
    std::uint64_t id = 0;
    ClashStatus mark = ClashStatus::reviewed; ///< reviewed or approved
    std::string note;
    std::int64_t marked = 0; ///< time of marking, in seconds since 1970

    [[nodiscard]] std::uint64_t checksum() const;
};

using Marks = std::unordered_map<std::uint64_t, MarkRow>;

/// Returns the serial number of the last mark that was set; 0 if none was.
std::int64_t last_mark(Database& database);

/// Reads all marks, by clash id.
/// Errors      Error{malformed}, naming the store, if a row does not match its checksum or is
///             missing.
Marks read_marks(Database& database);

/// put_mark replaces the mark of clash row.id, remove_mark removes one; both change the store and
/// `marks`. The caller holds a transaction.
void put_mark(Database& database, Marks& marks, MarkRow row);
void remove_mark(Database& database, Marks& marks, std::uint64_t id);

} // namespace abut
