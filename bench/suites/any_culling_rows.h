#pragma once

#include "suites/ccd_step_rows.h"

#include <vector>

namespace abut::bench {

/// Representatives for a culling of one's own, on the pairs of triangles whose swept boxes overlap:
/// - the tests around a contact, with what a regular mesh leads to;
/// - the feature tests left by boxes at both ends, and by 18-DOPs at both ends;
/// - a change of some triangles, beside a start from nothing;
/// - the same surface as a polygon soup, each triangle a little smaller, so that none touches
///   another.
std::vector<Row> any_culling_rows(const CcdStep& step, int rounds);

} // namespace abut::bench
