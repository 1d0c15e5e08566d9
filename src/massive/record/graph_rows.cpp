#include "massive/record/graph_rows.h"

#include <abut/error.h>

#include "massive/record/earlier_answers.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace abut {

namespace {

struct GraphTable {
    std::string_view name, sql;
};

/// SQLite stores these texts verbatim. Comparing them tells whether this version made a table.
constexpr GraphTable kTables[]{{"overlap_graph", R"(CREATE TABLE overlap_graph(
  clearance REAL NOT NULL,
  generation INTEGER NOT NULL,
  edges INTEGER NOT NULL,
  units INTEGER NOT NULL))"},
                               {"overlap_unit", R"(CREATE TABLE overlap_unit(
  unit INTEGER PRIMARY KEY,
  edges INTEGER NOT NULL,
  meshes INTEGER NOT NULL,
  bytes INTEGER NOT NULL,
  cut INTEGER NOT NULL))"},
                               {"overlap_edge", R"(CREATE TABLE overlap_edge(
  part_a INTEGER NOT NULL REFERENCES part,
  part_b INTEGER NOT NULL REFERENCES part,
  unit INTEGER NOT NULL REFERENCES overlap_unit,
  PRIMARY KEY(part_a, part_b)) WITHOUT ROWID)"}};

bool has_tables(Database& database) {
    Statement find(database, "SELECT sql = ? FROM sqlite_schema WHERE name = ?");
    return std::ranges::all_of(kTables, [&](const GraphTable& table) {
        find.bind(table.sql, table.name);
        return find.step() && find.integer(0) != 0;
    });
}

/// Errors      Error{bad_argument}, naming the store, if it has a foreign table of such a name.
void make_tables(Database& database) {
    if (has_tables(database))
        return;
    for (const GraphTable& table : kTables) {
        Statement find(database, "SELECT 1 FROM sqlite_schema WHERE name = ?");
        if (find.bind(table.name).step())
            throw Error(ErrorCode::bad_argument, database.path(),
                        "has another table " + std::string(table.name) +
                            ": the graph cannot be kept");
    }
    for (const GraphTable& table : kTables)
        Statement(database, table.sql).run();
    database.run("CREATE INDEX overlap_edge_by_b ON overlap_edge(part_b)");
}

struct Edge {
    std::int64_t a = 0, b = 0; ///< store rows of the parts
    std::uint64_t unit = 0;
};

} // namespace

void keep_graph(Database& database, double clearance, const StoredParts& stored,
                const std::vector<WorkUnit>& units) {
    make_tables(database);
    database.run("DELETE FROM overlap_graph; DELETE FROM overlap_unit; DELETE FROM overlap_edge");
    std::vector<Edge> edges;
    Statement add_unit(database, "INSERT INTO overlap_unit VALUES (?,?,?,?,?)");
    for (std::uint64_t u = 0; u < units.size(); ++u) {
        const WorkUnit& unit = units[u];
        add_unit
            .bind(u, std::uint64_t{unit.pairs.size()}, std::uint64_t{unit.meshes.size()},
                  unit.bytes, unit.cut ? 1 : 0)
            .run();
        for (const IndexPair& pair : unit.pairs)
            edges.push_back({stored.parts[pair.a()].row, stored.parts[pair.b()].row, u});
    }
    // Sorted by the table's primary key, so that every insertion appends.
    std::ranges::sort(
        edges, [](const Edge& x, const Edge& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
    Statement add_edge(database, "INSERT INTO overlap_edge VALUES (?,?,?)");
    for (const Edge& edge : edges)
        add_edge.bind(edge.a, edge.b, edge.unit).run();
    Statement(database, "INSERT INTO overlap_graph VALUES (?,?,?,?)")
        .bind(clearance, youngest_generation(stored.models), std::uint64_t{edges.size()},
              std::uint64_t{units.size()})
        .run();
}

} // namespace abut
