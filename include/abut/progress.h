#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace abut {

/// How long work reports and is stopped. Both members may be left empty.
struct Progress {
    /// Called with the stage's name and the fraction of it that is done, in [0, 1], from any
    /// thread, never from two at once.
    std::function<void(std::string_view stage, double fraction)> report;
    /// Set it to end the work with Error{interrupted}.
    const std::atomic<bool>* stop = nullptr;
};

/// Number of threads that parallel work uses from now on, in the whole process. 0: all of the
/// machine's.
void set_threads(int count);

/// The largest resident memory, in MiB, that this process has had, or any of its finished children,
/// if larger.
double peak_resident_mib();

} // namespace abut
