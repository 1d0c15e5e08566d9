#pragma once

#include <abut/crew.h>
#include <abut/progress.h>

#include "core/progress.h"
#include "massive/job_plan.h"
#include "massive/job_result.h"
#include "massive/piece_worker.h"
#include "massive/work_schedule.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <latch>
#include <mutex>
#include <thread>
#include <vector>

namespace abut {

/// The leader's side of a job that a crew does: pieces go out to whoever is free, what comes back is
/// put together and recorded. Two threads do that, so that none waits for the disk: one serves the
/// helpers, one records. The leader works too, with this as its source of pieces.
class CrewLead final : public WorkSource {
public:
    /// Begins to serve the helpers. In: all must outlive it.
    CrewLead(Crew& crew, const JobPlan& plan, JobResult& result, const ClashOptions& options);
    ~CrewLead() override;

    /// Waits until every helper has its first pieces: the leader does not take all of a small job before
    /// the others have heard of it.
    std::optional<WorkPiece> next() override;
    void done(PieceResult result) override;
    void on_pair() override;

    /// The work ends, because of the exception that is being handled, unless it has failed before.
    void fail();
    /// Waits for the helpers' last pieces.
    ///
    /// Errors      what went wrong first, wherever that was; Error{interrupted}.
    void finish();

private:
    void serve();
    void brief_helpers();
    void record();
    void handle(const Crew::Message& message);
    void hand_out(std::size_t worker);
    std::optional<WorkPiece> piece_for(std::size_t worker);
    Crew& crew_;
    const JobPlan& plan_;
    const ClashOptions& options_;
    ProgressMeter progress_;
    JobResult& result_; ///< the recorder's
    std::mutex mutex_;  ///< of the four that follow
    std::condition_variable to_record_;
    std::vector<PieceResult> done_; ///< to be recorded
    WorkSchedule schedule_;
    std::exception_ptr failure_;
    std::latch helpers_have_work_{1};
    std::atomic<bool> ended_ = false; ///< all is recorded, or the job has failed
    std::thread server_, recorder_;   ///< last: they use the others
};

} // namespace abut
