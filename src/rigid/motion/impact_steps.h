#pragma once

#include <abut/motion.h>

#include "core/stop.h"

#include <cstdint>
#include <limits>

namespace abut {

/// Counts the steps of one search for a first contact, up to a limit, and reports its progress.
class ImpactSteps {
public:
    explicit ImpactSteps(const ImpactOptions& options)
        : progress_(options.progress),
          steps_(options.max_steps.value_or(std::numeric_limits<std::uint64_t>::max())),
          next_report_(progress_.report ? 0 : std::numeric_limits<double>::infinity()) {}

    /// Counts a step. Returns false, and counts nothing, if the limit is reached. Call it before
    /// each step.
    ///
    /// In          free: the time up to which the motion is free.
    bool take(double free) {
        if (!steps_.take())
            return false;
        if (free >= next_report_) {
            progress_.report("time of impact", free);
            next_report_ = free + 0.01;
            poll_stop(); // the report may have set the flag
        }
        return true;
    }
    [[nodiscard]] std::uint64_t count() const { return steps_.count(); }

private:
    const Progress& progress_;
    SearchSteps steps_;
    double next_report_; ///< a time
};

/// The answer of a search that has reached its limit: the motion is free up to `time`.
inline Impact out_of_steps(double time) {
    Impact impact;
    impact.meet = true;
    impact.time = time;
    impact.status = Status::bound_only;
    impact.out_of_steps = true;
    return impact;
}

} // namespace abut
