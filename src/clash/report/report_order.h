#pragma once

#include <abut/clash.h>

namespace abut {

/// Completes a report that has all clashes, sorted by part: counts them by kind, by neighbours and
/// by the cells of the options' matrix, and puts them into the order of the options.
void sum_up(ClashReport& report, const ClashOptions& options);

} // namespace abut
