#pragma once

#include "report.h"

#include <string>
#include <vector>

namespace abut::bench {

/// Measures the clash job between model files, on one thread: its narrow phase with depths and
/// volumes, against the bare questions (`collide` for the first contact, and `within`) on its hard
/// pairs. Adds rows.
void add_hard_pair_rows(const std::vector<std::string>& files, int rounds, Report& report);

} // namespace abut::bench
