#pragma once

#include "report.h"

namespace abut::bench {

/// Adds rows for the distance of two plates that face each other, from 1 to 10,000 m apart: flat ones,
/// and ones with a roughness of 0.1 mm. Beside the fastest of FCL's volumes.
void add_far_apart_rows(int rounds, bool alone, Report& report);

} // namespace abut::bench
