#pragma once

#include "store/database/sqlite.h"

#include <string_view>

namespace abut {

/// A table that a store may lack: the first write creates it. A foreign program may have made
/// another table of the same name; such a table is left alone and counts as absent.
struct OptionalTable {
    std::string_view name;
    std::string_view definition; ///< the CREATE TABLE statement

    /// Returns whether the table exists, with this definition.
    [[nodiscard]] bool exists(Database& database) const;

    /// Creates the table unless there is one of its name. Returns whether it now exists. Call it
    /// within a transaction.
    [[nodiscard]] bool create(Database& database) const;
};

} // namespace abut
