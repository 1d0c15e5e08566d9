#pragma once

#include "report.h"

#include <cstdint>

namespace abut::bench {

/// Adds a row for bodies of several kinds that fly and bounce in a box: how many distance queries
/// the schedule makes, compared with one per pair and step, and the time of its steps, compared
/// with an update that finds all touching pairs.
void add_flight_rows(Report& report, int bodies, std::uint64_t seed);

} // namespace abut::bench
