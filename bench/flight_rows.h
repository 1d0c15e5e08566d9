#pragma once

#include "report.h"

#include <cstdint>

namespace abut::bench {

/// Bodies of several kinds in flight, bouncing in a box: distance queries of a schedule, against one a
/// pair a step; and the time of its steps, beside that of all pairs that touch.
void add_flight_rows(Report& report, int bodies, std::uint64_t seed);

} // namespace abut::bench
