#pragma once

#include <abut/crew.h>
#include <abut/progress.h>

#include "core/progress.h"
#include "massive/job/job_plan.h"
#include "massive/job/job_result.h"
#include "massive/work/task_worker.h"
#include "massive/work/work_schedule.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <latch>
#include <mutex>
#include <thread>
#include <vector>

namespace abut {

/// The leader's side of a crew's job. It hands out tasks to free workers, then collects and records
/// their results. One thread serves the helpers and another one records, so that no helper waits
/// for the disk. The leader itself is a worker too, with this object as its source of tasks.
class CrewLead final : public WorkSource {
public:
    /// Starts both threads. All arguments must outlive this object.
    CrewLead(Crew& crew, const JobPlan& plan, JobResult& result, const ClashOptions& options);
    ~CrewLead() override;

    /// Returns the leader's own next task. Waits until every helper has its first tasks, so that
    /// the leader does not take all of a small job.
    std::optional<Task> next() override;
    void done(TaskResult result) override;
    void on_pair() override;

    /// Ends the work. Keeps the exception that is being handled, unless an earlier failure is
    /// known.
    void fail();
    /// Waits until all results are recorded.
    ///
    /// Errors      the first failure of any process; Error{interrupted}.
    void finish();

private:
    void serve();
    void brief_helpers();
    void record();
    void handle(const Crew::Message& message);
    void hand_out(std::size_t worker);
    std::optional<Task> task_for(std::size_t worker);
    Crew& crew_;
    const JobPlan& plan_;
    const ClashOptions& options_;
    ProgressMeter progress_;
    JobResult& result_; ///< used by the recorder only
    std::mutex mutex_;  ///< guards the next four members
    std::condition_variable to_record_;
    std::vector<TaskResult> done_; ///< results to record
    WorkSchedule schedule_;
    std::exception_ptr failure_;
    std::latch helpers_have_work_{1};
    std::atomic<bool> ended_ = false; ///< all results are recorded, or the job has failed
    std::thread server_, recorder_;   ///< declared last: they use the other members
};

} // namespace abut
