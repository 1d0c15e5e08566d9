#include "core/parallel.h"

#include <abut/error.h>
#include <abut/progress.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <tbb/global_control.h>
#include <utility>

#ifdef __SANITIZE_THREAD__
#include <thread>
#include <vector>
#endif

namespace abut {

namespace {

std::mutex g_mutex;
std::unique_ptr<tbb::global_control> g_limit;
std::shared_ptr<const TaskPool> g_pool; ///< the caller's
std::atomic<bool> g_has_pool = false;

thread_local bool t_is_one_thread = false; ///< this thread's parallel work has no other thread

#ifdef __SANITIZE_THREAD__
// The thread sanitizer cannot see into the packaged oneTBB and reports its synchronisation as races.
// Plain threads in its place show the races of this library's own code.
void run_on_plain_threads(std::size_t count, const std::function<void(std::size_t)>& task) {
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count; ++i)
        threads.emplace_back(task, i);
    for (std::thread& thread : threads)
        thread.join();
}
#endif

} // namespace

OneThread::OneThread() : before_(std::exchange(t_is_one_thread, true)) {}

OneThread::~OneThread() {
    t_is_one_thread = before_;
}

void TaskPool::run(std::size_t count, const std::function<void()>& work) const {
    struct Job {
        const std::function<void()>& work;
        std::mutex mutex;
        std::exception_ptr failure;
    } job{work, {}, {}};
    const auto task = [&job](std::size_t) {
        try {
            job.work();
        } catch (...) {
            const std::scoped_lock lock(job.mutex);
            job.failure = std::current_exception();
        }
    };
    try {
        runner_(std::min(count, threads_), task);
    } catch (...) { // NOLINT(bugprone-empty-catch): it takes no tasks, so they are done here
    }
    task(0); // what is left; nothing, if the tasks have run
    if (job.failure)
        std::rethrow_exception(job.failure);
}

std::shared_ptr<const TaskPool> task_pool() {
    if (g_has_pool) {
        const std::scoped_lock lock(g_mutex);
        return g_pool;
    }
#ifdef __SANITIZE_THREAD__
    static const auto plain = std::make_shared<const TaskPool>(run_on_plain_threads, 4);
    return plain;
#else
    return nullptr;
#endif
}

bool has_callers_pool() {
    return g_has_pool;
}

bool is_sequential() {
    if (t_is_one_thread)
        return true;
    if (const auto pool = task_pool())
        return pool->threads() == 1;
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) == 1;
}

void set_threads(int count) {
    if (count < 0)
        throw Error(ErrorCode::bad_argument, "threads must not be negative");
    const std::scoped_lock lock(g_mutex);
    // The old limit ends after the new one has begun, so that no query meanwhile runs without one.
    std::unique_ptr<tbb::global_control> limit;
    if (count > 0)
        limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(count));
    g_limit = std::move(limit);
}

void set_task_runner(TaskRunner run, int threads) {
    if (run && threads < 1)
        throw Error(ErrorCode::bad_argument, "a task runner needs at least one thread");
    std::shared_ptr<const TaskPool> pool;
    if (run)
        pool = std::make_shared<const TaskPool>(
            [run = std::move(run)](std::size_t count,
                                   const std::function<void(std::size_t)>& task) {
                run(count, [&task](std::size_t i) {
                    const OneThread here;
                    task(i);
                });
            },
            static_cast<std::size_t>(threads));
    const std::scoped_lock lock(g_mutex);
    g_has_pool = pool != nullptr;
    std::swap(g_pool, pool);
}

} // namespace abut
