#pragma once

#include "report.h"

namespace abut::bench {

/// Adds rows of the contacts of separate triangles with a rigid body: triangles as large as the
/// body, and small ones, that pass over its surface or through it. Microseconds a triangle, its
/// vertices included.
void add_contact_rows(Report& report, int rounds);

} // namespace abut::bench
