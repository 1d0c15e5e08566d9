#pragma once

#include <abut/crew.h>
#include <abut/progress.h>

#include "core/progress.h"
#include "massive/job_plan.h"
#include "massive/job_result.h"
#include "massive/piece_worker.h"
#include "massive/work_schedule.h"

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace abut {

/// The leader's side of a job that a crew does: pieces go out to whoever is free, what comes back is
/// put together and recorded. A thread of its own does that; the leader works too, with this as its
/// source of pieces, and does not wait for the disk.
class CrewLead final : public WorkSource {
public:
    /// Begins to serve the helpers. In: all must outlive it.
    CrewLead(Crew& crew, const JobPlan& plan, JobResult& result, const ClashOptions& options);
    ~CrewLead() override;

    std::optional<WorkPiece> next() override { return piece_for(0); }
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
    void handle(const Crew::Message& message);
    void hand_out(std::size_t worker);
    std::optional<WorkPiece> piece_for(std::size_t worker);
    void take(PieceResult result, std::size_t worker);
    void take_own();

    Crew& crew_;
    const JobPlan& plan_;
    const ClashOptions& options_;
    ProgressMeter progress_;
    JobResult& result_;      ///< the server's
    std::size_t units_left_; ///< that no result has come from; the server's
    std::mutex mutex_;       ///< of the three that follow
    WorkSchedule schedule_;
    std::vector<PieceResult> own_; ///< the leader's, to be taken
    std::exception_ptr failure_;
    std::atomic<bool> failed_ = false;
    std::thread server_; ///< last: it uses the others
};

} // namespace abut
