#pragma once

#include "report.h"

#include <cstdint>

namespace abut::bench {

/// Adds a row for each of the moving scenes: a step of the schedule, against a step of update and
/// touching in the same world. Throws std::logic_error if the two find different pairs.
void add_schedule_rows(Report& report, std::uint64_t seed);

} // namespace abut::bench
