#pragma once

#include "store/sqlite.h"

#include <cstdint>

namespace abut {

/// The last import that changed something, in a model that may be gone since. Numbers are never used
/// again: what is older than a job is what the job has seen.
std::uint64_t last_generation(Database& database);

/// Keeps that number whatever becomes of the models.
void keep_generation(Database& database);

} // namespace abut
