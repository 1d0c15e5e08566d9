#pragma once

#include <abut/progress.h>

#include "core/stop.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

namespace abut {

/// Threads that help with parallel work in place of oneTBB's.
class TaskPool {
public:
    TaskPool(TaskRunner runner, std::size_t threads)
        : runner_(std::move(runner)), threads_(threads) {}

    /// How many tasks it takes at once.
    [[nodiscard]] std::size_t threads() const { return threads_; }
    /// Calls work() in at most `count` tasks, and returns when all have ended. Then calls it once more
    /// here, for what a pool that takes no tasks has left: work() does what is not done yet.
    ///
    /// Errors      if work() throws, one of the exceptions.
    void run(std::size_t count, const std::function<void()>& work) const;

private:
    TaskRunner runner_;
    std::size_t threads_;
};

/// The threads that help now: the caller's of `set_task_runner`. Null for oneTBB's.
std::shared_ptr<const TaskPool> task_pool();
/// Whether parallel work now goes to the pool of `set_task_runner`.
bool has_callers_pool();

/// Gives this thread's parallel work no other thread until the end of the scope.
class OneThread {
public:
    OneThread();
    ~OneThread();
    OneThread(const OneThread&) = delete;
    OneThread& operator=(const OneThread&) = delete;

private:
    bool before_;
};

/// Returns whether work has one thread only. Another thread may change that at any time, so the answer says
/// what is best, and nothing may depend on it.
bool is_sequential();

/// Calls body(i) for every i in [0, count), in parallel, in chunks of at least `grain`.
///
/// The order of the calls is not fixed, so write results to slot i. If calls throw, one of the
/// exceptions reaches the caller. Each chunk first polls the stop flag of the caller's work, and then
/// works under that flag.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
    const auto chunk = [&](std::size_t begin, std::size_t end) {
        poll_stop();
        for (std::size_t i = begin; i < end; ++i)
            body(i);
    };
    if (count <= grain)
        return chunk(0, count);
    if (is_sequential()) {
        for (std::size_t i = 0; i < count; i += grain)
            chunk(i, std::min(i + grain, count));
        return;
    }
    const std::atomic<bool>* const stop = t_stop_flag;
    if (const auto pool = task_pool()) {
        // Several chunks a thread: one that is late holds up the others for a fraction of the work.
        constexpr std::size_t kChunks = 8;
        const std::size_t step = std::max(grain, count / (kChunks * pool->threads()));
        std::atomic<std::size_t> next{0};
        const auto work = [&] {
            const StopScope scope(stop);
            try {
                for (std::size_t i = next.fetch_add(step); i < count; i = next.fetch_add(step))
                    chunk(i, std::min(i + step, count));
            } catch (...) {
                next = count; // the others need not go on
                throw;
            }
        };
        pool->run((count + step - 1) / step, std::cref(work));
        return;
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          const StopScope scope(stop);
                          chunk(range.begin(), range.end());
                      });
}

/// Calls body(). While this thread waits inside for parallel work, it takes up no unrelated task and
/// polls no stop flag. Use it while holding a lock.
template <typename Body>
void isolated(const Body& body) {
    const StopScope unstoppable(nullptr);
    if (has_callers_pool()) { // what its threads take up while they wait is not ours to say
        const OneThread here;
        return body();
    }
#ifdef __SANITIZE_THREAD__
    body();
#else
    tbb::this_task_arena::isolate(body);
#endif
}

/// Sorts like std::sort.
template <typename Iterator>
void parallel_sort(Iterator begin, Iterator end) {
    constexpr std::size_t kFew = 4096;
    const auto pool = task_pool();
    const auto count = static_cast<std::size_t>(std::distance(begin, end));
    if (!pool)
        return tbb::parallel_sort(begin, end);
    if (count < kFew || is_sequential())
        return std::sort(begin, end);
    // Sorts parts, and then merges neighbours.
    const auto at = [&](std::size_t i) {
        return begin + static_cast<std::ptrdiff_t>(std::min(i, count));
    };
    std::size_t part = (count + pool->threads() - 1) / pool->threads();
    parallel_for(pool->threads(), 1,
                 [&](std::size_t i) { std::sort(at(i * part), at((i + 1) * part)); });
    for (; part < count; part *= 2)
        parallel_for((count + 2 * part - 1) / (2 * part), 1, [&](std::size_t i) {
            std::inplace_merge(at(2 * i * part), at((2 * i + 1) * part), at((2 * i + 2) * part));
        });
}

} // namespace abut
