#pragma once

#include <abut/progress.h>

#include <atomic>
#include <cstddef>
#include <mutex>
#include <string_view>

namespace abut {

/// Reports the progress of one stage of a long job, at most once a percent. Ends the stage with an
/// exception when the caller asks to stop.
class ProgressMeter {
public:
    ProgressMeter(const Progress& progress, std::string_view stage, std::size_t total);

    /// May be called from any thread. Errors: Error{interrupted}.
    void advance(std::size_t steps = 1);

private:
    const Progress& progress_;
    std::string_view stage_;
    std::size_t total_;
    std::atomic<std::size_t> done_{0};
    std::mutex mutex_;
    std::size_t next_percent_ = 0;
};

/// Throws Error{interrupted} if the caller asked to stop.
void check_stop(const Progress& progress);

} // namespace abut
