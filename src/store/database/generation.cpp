#include "store/database/generation.h"

#include <algorithm>

namespace abut {

// The number is kept in sqlite_sequence, SQLite's own table of counters. It exists because some
// tables of a store use AUTOINCREMENT.

std::uint64_t last_generation(Database& database) {
    return static_cast<std::uint64_t>(
        std::max(database.number("SELECT max(generation) FROM model"),
                 database.number("SELECT seq FROM sqlite_sequence WHERE name = 'generation'")));
}

void keep_generation(Database& database) {
    const std::uint64_t last = last_generation(database);
    database.run("DELETE FROM sqlite_sequence WHERE name = 'generation'");
    Statement(database, "INSERT INTO sqlite_sequence(name, seq) VALUES ('generation', ?)")
        .bind(last)
        .run();
}

} // namespace abut
