#pragma once

#include "store/database/sqlite.h"

/// The tables of groups and topics in a store. docs/clash-groups.md and docs/topics.md explain the
/// columns.
namespace abut {

/// Creates the tables that are missing, those of jobs too. The caller holds a transaction.
void prepare_coordination_tables(Database& database);
/// Returns whether all tables exist.
/// Errors      of both functions: Error{malformed}, naming the store, if it has a foreign table of
///             such a name.
bool has_coordination_tables(Database& database);

} // namespace abut
