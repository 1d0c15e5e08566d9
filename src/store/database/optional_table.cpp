#include "store/database/optional_table.h"

namespace abut {

bool OptionalTable::exists(Database& database) const {
    // SQLite stores the text of a definition unchanged.
    Statement find(database, "SELECT sql = ? FROM sqlite_schema WHERE name = ?");
    find.bind(definition, name);
    return find.step() && find.integer(0) != 0;
}

bool OptionalTable::create(Database& database) const {
    Statement find(database, "SELECT 1 FROM sqlite_schema WHERE name = ?");
    find.bind(name);
    if (!find.step())
        Statement(database, definition).run();
    return exists(database);
}

} // namespace abut
