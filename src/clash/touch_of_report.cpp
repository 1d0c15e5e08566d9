#include "clash/touch_of_report.h"

#include <algorithm>

namespace abut {

void TouchOfReport::add(const PairPrecision& precision, std::size_t i, std::size_t k) {
    const double tolerance = precision.tolerance(i, k);
    least_ = largest_ < 0 ? tolerance : std::min(least_, tolerance);
    if (!(tolerance > largest_))
        return;
    largest_ = tolerance;
    origin_ = precision.origin(i, k);
}

void TouchOfReport::tell(const ClashOptions& options, ClashReport& report) const {
    const double largest = std::max(largest_, 0.0);
    report.touch_tolerance = options.touch_tolerance.value_or(largest);
    report.least_touch_tolerance = options.touch_tolerance.value_or(least_);
    report.touch_source = options.touch_tolerance ? TouchSource::option
                          : largest == 0          ? TouchSource::none
                          : origin_.stated        ? TouchSource::precision
                                                  : TouchSource::rounding;
    if (!options.touch_tolerance && largest > 0)
        report.touch_file = report.models.at(origin_.model).file;
}

} // namespace abut
