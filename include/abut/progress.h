#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace abut {

/// Reports and stops long work. Every query that may take long has one, as the member `progress` of
/// its options or as its last argument. Both members may be left empty.
struct Progress {
    /// Called with the stage's name and the fraction of it that is finished, in [0, 1]. The call
    /// comes from any thread, but never from two at once. A single query of two models reports
    /// nothing, except `time_of_impact`.
    std::function<void(std::string_view stage, double fraction)> report;
    /// Set this flag, from any thread, to end the work with Error{interrupted}. Unfinished work
    /// returns no answer. A search polls the flag every few hundred steps.
    const std::atomic<bool>* stop = nullptr;
};

/// Sets the number of threads for all later parallel work of the process. 0: all threads of the
/// machine.
void set_threads(int count);

/// Returns the peak resident memory, in MiB, of this process or of any of its finished children,
/// whichever is larger.
double peak_resident_mib();

} // namespace abut
