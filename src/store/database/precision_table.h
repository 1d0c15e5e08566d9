#pragma once

#include <abut/scene.h>

#include "store/database/sqlite.h"

#include <cstdint>

/// The table of what the models tell apart (ModelPrecision). The first import of this version
/// creates it; a model without a row has the precision of a scene about which nothing is known.
/// docs/store-tables.md describes the columns.
namespace abut {

/// Errors      Error{malformed}, naming the store, if the row does not match its checksum.
ModelPrecision read_precision(Database& database, std::int64_t model);

/// Replaces the row of a model. Does nothing if there is a foreign table of this name. Call it
/// within a transaction.
void write_precision(Database& database, std::int64_t model, const ModelPrecision& precision);

/// Removes the rows of models that no longer exist. Call it within a transaction.
void remove_lost_precisions(Database& database);

} // namespace abut
