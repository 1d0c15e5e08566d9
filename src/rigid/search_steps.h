#pragma once

#include <abut/motion.h>

#include "core/progress.h"

#include <cstdint>
#include <limits>

namespace abut {

/// Counts the steps of one search for a first contact, up to its limit, and ends it when the caller
/// asks for that.
class SearchSteps {
public:
    explicit SearchSteps(const ImpactOptions& options)
        : progress_(options.progress),
          most_(options.max_steps.value_or(std::numeric_limits<std::uint64_t>::max())),
          next_report_(progress_.report ? 0 : std::numeric_limits<double>::infinity()) {}

    /// Before each step. Returns false, and counts nothing, if the limit is reached.
    ///
    /// In          free: the motion is free up to this time.
    /// Errors      Error{interrupted}.
    bool take(double free) {
        if (progress_.stop != nullptr)
            check_stop(progress_);
        if (count_ >= most_)
            return false;
        ++count_;
        if (free >= next_report_) {
            progress_.report("time of impact", free);
            next_report_ = free + 0.01;
        }
        return true;
    }
    [[nodiscard]] std::uint64_t count() const { return count_; }

private:
    const Progress& progress_;
    std::uint64_t most_, count_ = 0;
    double next_report_; ///< a time
};

/// The answer of a search that has reached its limit: the motion is free up to `time`.
inline Impact out_of_steps(double time) {
    Impact impact;
    impact.hit = true;
    impact.time = time;
    impact.status = Status::bound_only;
    impact.out_of_steps = true;
    return impact;
}

} // namespace abut
