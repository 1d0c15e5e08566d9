#pragma once

#include "massive/stored_parts.h"
#include "massive/work_units.h"
#include "store/sqlite.h"

#include <vector>

/// One overlap graph in a store, for questions in SQL: the last that was to be kept. No job reads it, since
/// finding and cutting the graph takes no longer. docs/massive.md says what the columns mean.
namespace abut {

/// Keeps a graph in place of the one before. Within a transaction.
///
/// In          units: which hold its edges.
/// Errors      Error{bad_argument}, naming the store, if it has other tables of these names.
void keep_graph(Database& database, double clearance, const StoredParts& stored,
                const std::vector<WorkUnit>& units);

} // namespace abut
