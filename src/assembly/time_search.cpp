#include "assembly/time_search.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut {

TimeSearch::TimeSearch(std::function<TimeValue(double)> measure,
                       std::function<double(double, double)> change)
    : measure_(std::move(measure)), change_(std::move(change)) {}

void TimeSearch::add(const TimeValue& from, const TimeValue& to) {
    for (const TimeValue& each : {from, to})
        if (each.value < best_.value)
            best_ = each;
    // Both ends bound the function by a cone; the cones meet here.
    const double meeting = 0.5 * (from.at_least + to.at_least - change_(from.time, to.time));
    spans_.push({from, to, std::min({meeting, from.at_least, to.at_least})});
}

void TimeSearch::run(double absolute_error, double relative_error, std::size_t most) {
    for (std::size_t i = 0; i < most && !spans_.empty(); ++i) {
        poll_stop();
        const Span span = spans_.top();
        const double allowed = std::max(absolute_error, relative_error * std::abs(best_.value));
        const double middle = span.from.time + 0.5 * (span.to.time - span.from.time);
        if (best_.value - span.at_least <= allowed)
            return;
        spans_.pop();
        if (!(span.from.time < middle) || !(middle < span.to.time)) {
            undivided_ = std::min(undivided_, span.at_least);
            continue;
        }
        const TimeValue value = measure_(middle);
        add(span.from, value);
        add(value, span.to);
    }
}

double TimeSearch::at_least() const {
    const double least = std::min(best_.at_least, undivided_);
    return spans_.empty() ? least : std::min(least, spans_.top().at_least);
}

} // namespace abut
