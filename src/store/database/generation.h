#pragma once

#include "store/database/sqlite.h"

#include <cstdint>

namespace abut {

/// The number of the last import that changed something, even if its model has been removed since.
/// Numbers are never reused: a job has seen everything with a number up to that of its own start.
std::uint64_t last_generation(Database& database);

/// Stores that number, so that it survives the removal of models.
void keep_generation(Database& database);

} // namespace abut
