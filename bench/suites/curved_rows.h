#pragma once

#include "report.h"

#include <cstddef>
#include <cstdint>

namespace abut::bench {

/// Adds rows for cylinders, cones and ellipsoids: contacts and depths of all pairs of boxes in a
/// world of `bodies` of one kind. Counters tell where the peer's answers differ.
void add_curved_rows(Report& report, std::size_t bodies, std::uint64_t seed);

} // namespace abut::bench
