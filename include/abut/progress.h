#pragma once

#include <atomic>
#include <cstddef>
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

/// A thread pool of the caller's. It calls task(i) once for each i below `count`, on any of its
/// threads or on the one that asks, in any order, and returns when all these calls have returned. Abut
/// calls it from any thread that asks a query, also from several at once.
using TaskRunner =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// Hands the parallel parts of all later queries of the process to a thread pool of the caller's, in
/// place of Abut's own threads. Results do not depend on it. An empty function returns to Abut's own
/// threads, and `set_threads` then counts again.
///
/// The tasks throw nothing, wait for no other task, and call the pool from none of its threads.
/// Reading files, imports into a store, levels of detail and what a walk loads ahead keep threads of
/// their own.
///
/// In          threads: how many tasks a query hands in at most at once. The function may throw, or leave
///             tasks out, but only while none of them runs: the thread that asks does what is left.
/// Errors      Error{bad_argument}: threads below 1.
void set_task_runner(TaskRunner run, int threads);

/// Returns the peak resident memory, in MiB, of this process or of any of its finished children,
/// whichever is larger.
double peak_resident_mib();

} // namespace abut
