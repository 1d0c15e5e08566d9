#include "store/generation.h"

#include <algorithm>

namespace abut {

// SQLite keeps its own counters in this table, which the tables of a store have anyway.

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
