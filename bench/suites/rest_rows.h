#pragma once

#include "report.h"
#include "suites/ccd_step_rows.h"

namespace abut::bench {

/// A row of the edges through faces of a step's first frame, found at rest, beside CGAL's pairs of
/// triangles that intersect.
Row at_rest_row(const CcdStep& step, int rounds);

/// A row of the pairs of features that are near each other in a step's first frame, at most 0.3 mean
/// edges apart, beside the impacts of the same surface at rest with that thickness.
Row near_row(const CcdStep& step, int rounds);
/// Adds rows as near_row of two generated surfaces.
void add_near_rows(Report& report, int rounds);

/// Adds a row of a world with one waving cloth of about 40,000 triangles and a small model:
/// `refresh` and `within` after a step of the cloth, beside a build of the cloth as a new model.
/// Processor time of one thread.
void add_refresh_row(Report& report, int steps);

} // namespace abut::bench
