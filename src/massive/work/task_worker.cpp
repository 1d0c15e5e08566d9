#include "massive/work/task_worker.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <tbb/global_control.h>
#include <utility>

namespace abut {

void work(TaskTester& tester, WorkSource& source) {
    // With one thread only, the next task is loaded after the test instead of beside it.
    const auto policy =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) > 1
            ? std::launch::async
            : std::launch::deferred;
    using Clock = std::chrono::steady_clock;
    Clock::time_point given; // when the source gave the last task
    // The next task: already loaded, or still to be loaded because it needs the memory for itself.
    struct Coming {
        std::optional<Task> task;
        std::optional<TaskTester::Loaded> loaded;
    };
    const auto fetch = [&](bool beside) {
        Coming coming{source.next(), {}};
        given = Clock::now();
        if (coming.task && beside && !coming.task->alone)
            coming.loaded = tester.load(*std::exchange(coming.task, {}));
        return coming;
    };
    const auto load = [&](Coming coming) {
        if (coming.task)
            coming.loaded = tester.load(*std::move(coming.task));
        return std::move(coming.loaded);
    };
    double waiting = 0;
    for (auto loaded = load(fetch(false)); loaded;) {
        std::future<Coming> next = std::async(policy, fetch, !loaded->task.alone);
        TaskResult result;
        try {
            result = tester.test(*loaded, [&] { source.on_pair(); });
        } catch (...) {
            source.give_up();
            throw;
        }
        const auto tested = Clock::now();
        Coming coming = next.get();
        waiting += std::max(0.0, std::chrono::duration<double>(given - tested).count());
        loaded = load(std::move(coming));
        result.worker = tester.figures();
        result.worker.waiting_seconds = waiting;
        result.hierarchies = tester.take_built();
        source.done(std::move(result));
    }
}

} // namespace abut
