#pragma once

#include "report.h"
#include "suites/ccd_step_rows.h"

namespace abut::bench {

/// A row of the edges through faces of a step's first frame, found at rest, beside CGAL's pairs of
/// triangles that intersect.
Row at_rest_row(const CcdStep& step, int rounds);

/// Rows of a world with one waving cloth of about 40,000 triangles and a small model: a step of the
/// cloth, and `refresh` with `within`, beside a build of the cloth as a new model.
void add_refresh_rows(Report& report, int steps);

} // namespace abut::bench
