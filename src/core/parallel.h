#pragma once

#include "core/stop.h"

#include <cstddef>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#ifdef __SANITIZE_THREAD__
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace abut {

/// Returns whether work has one thread only. Another thread may change that at any time, so the answer says
/// what is best, and nothing may depend on it.
inline bool is_sequential() {
#ifdef __SANITIZE_THREAD__
    return false;
#else
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) == 1;
#endif
}

/// Calls body(i) for every i in [0, count), in parallel, in chunks of at least `grain`.
///
/// The order of the calls is not fixed, so write results to slot i. If calls throw, one of the
/// exceptions reaches the caller. Each chunk first polls the stop flag of the caller's work, and then
/// works under that flag.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
    if (count <= grain) {
        poll_stop();
        for (std::size_t i = 0; i < count; ++i)
            body(i);
        return;
    }
    const std::atomic<bool>* const stop = t_stop_flag;
#ifndef __SANITIZE_THREAD__
    if (is_sequential()) {
        for (std::size_t i = 0; i < count; ++i) {
            if (i % grain == 0)
                poll_stop();
            body(i);
        }
        return;
    }
#else
    // The thread sanitizer cannot see into the packaged oneTBB and reports its synchronisation as
    // races. Plain threads in its place show the races of this library's own code.
    std::atomic<std::size_t> next{0};
    std::mutex failing;
    std::exception_ptr failure;
    const auto work = [&] {
        try {
            const StopScope scope(stop);
            for (std::size_t i = next.fetch_add(grain); i < count; i = next.fetch_add(grain)) {
                poll_stop();
                for (std::size_t k = i; k < std::min(i + grain, count); ++k)
                    body(k);
            }
        } catch (...) {
            const std::scoped_lock lock(failing);
            failure = std::current_exception();
        }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back(work);
    for (std::thread& thread : threads)
        thread.join();
    if (failure)
        std::rethrow_exception(failure);
#endif
#ifndef __SANITIZE_THREAD__
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          const StopScope scope(stop);
                          poll_stop();
                          for (std::size_t i = range.begin(); i != range.end(); ++i)
                              body(i);
                      });
#endif
}

/// Calls body(). While this thread waits inside for parallel work, it takes up no unrelated task and
/// polls no stop flag. Use it while holding a lock.
template <typename Body>
void isolated(const Body& body) {
    const StopScope unstoppable(nullptr);
#ifdef __SANITIZE_THREAD__
    body();
#else
    tbb::this_task_arena::isolate(body);
#endif
}

/// Sorts like std::sort.
template <typename Iterator>
void parallel_sort(Iterator begin, Iterator end) {
#ifdef __SANITIZE_THREAD__
    std::sort(begin, end);
#else
    tbb::parallel_sort(begin, end);
#endif
}

} // namespace abut
