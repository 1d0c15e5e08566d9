#pragma once

#include "massive/work/task.h"
#include "massive/work/task_tester.h"

#include <optional>

namespace abut {

/// Gives a worker its tasks and takes its results.
class WorkSource {
public:
    virtual ~WorkSource() = default;
    /// Returns the next task; none if there is no more work. Waits until that is known.
    virtual std::optional<Task> next() = 0;
    virtual void done(TaskResult result) = 0;
    /// Called after each pair, from any thread. An exception that it throws ends the work.
    virtual void on_pair() = 0;
    /// Called when the work has failed: a call of next() that waits in another thread must return
    /// or throw soon.
    virtual void give_up() {}
};

/// Does tasks until there are none. While one is tested, the data of the next one are read. `done`
/// is called while nothing is being read, and never at the same time as `next`.
///
/// Errors      those of the tester and the source.
void work(TaskTester& tester, WorkSource& source);

} // namespace abut
