#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace abut {

/// How long work reports and is stopped: every query that can be long takes one, as the member
/// `progress` of its options or as its last argument. Both members may be left empty.
struct Progress {
    /// Called with the stage's name and the fraction of it that is done, in [0, 1], from any
    /// thread, never from two at once. A single query of two models reports nothing, but for
    /// `time_of_impact`.
    std::function<void(std::string_view stage, double fraction)> report;
    /// Set it, from any thread, to end the work with Error{interrupted}: no answer is made of work
    /// that was not finished. The flag is polled every some hundred steps of a search.
    const std::atomic<bool>* stop = nullptr;
};

/// Number of threads that parallel work uses from now on, in the whole process. 0: all of the
/// machine's.
void set_threads(int count);

/// The largest resident memory, in MiB, that this process has had, or any of its finished children,
/// if larger.
double peak_resident_mib();

} // namespace abut
