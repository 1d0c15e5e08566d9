#pragma once

#include "massive/work/stored_parts.h"
#include "massive/work/work_units.h"
#include "store/database/sqlite.h"

#include <vector>

/// The last overlap graph that was kept in a store, for queries in SQL. No job reads it, because
/// finding and cutting the graph takes no longer than reading it. docs/massive.md explains the
/// columns.
namespace abut {

/// Stores a graph and removes the one stored before. The caller holds a transaction.
///
/// In          units: the work units, whose pairs are the edges of the graph.
/// Errors      Error{bad_argument}, naming the store, if it has foreign tables of these names.
void keep_graph(Database& database, double clearance, const StoredParts& stored,
                const std::vector<WorkUnit>& units);

} // namespace abut
