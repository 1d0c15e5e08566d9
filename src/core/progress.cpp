#include "core/progress.h"

#include <abut/error.h>

namespace abut {

ProgressMeter::ProgressMeter(const Progress& progress, std::string_view stage, std::size_t total)
    : progress_(progress), stage_(stage), total_(total) {
    advance(0);
}

void ProgressMeter::advance(std::size_t steps) {
    check_stop(progress_);
    if (!progress_.report)
        return;
    const std::size_t done = done_.fetch_add(steps) + steps;
    const std::size_t percent = total_ == 0 ? 100 : 100 * done / total_;
    // A thread does not wait for another thread's report.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock() && percent + 1 > next_percent_) {
        next_percent_ = percent + 1;
        progress_.report(stage_, static_cast<double>(percent) / 100);
    }
}

void check_stop(const Progress& progress) {
    if (progress.stop != nullptr && progress.stop->load(std::memory_order_relaxed))
        throw Error(ErrorCode::interrupted, "interrupted");
}

} // namespace abut
