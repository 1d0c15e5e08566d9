#pragma once

#include <abut/scene.h>
#include <abut/store_clash.h>

#include "massive/job_plan.h"
#include "massive/work_piece.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace abut {

/// What a job has found so far, piece by piece, recorded in the store where the plan has a record.
class JobResult {
public:
    /// In          plan, options and store must outlive it.
    JobResult(JobPlan& plan, const ClashOptions& options, StoreFile& store, std::size_t workers);

    /// What was found before the job was stopped.
    void recall();

    /// What was found in some pieces. Once it returns, they are recorded, at the cost of one commit.
    void take(std::vector<PieceResult> results);

    /// All of it: clashes in the order of their parts, which are known by their places among those
    /// that clash. The job has ended.
    StoreClashReport finish();

    [[nodiscard]] const OutOfCoreCounters& counters() const { return result_.counters; }

private:
    void add(PieceResult result);
    void sum_up_workers();
    void add_model(const ModelRow& row);
    void set_models(Clash& clash) const;

    JobPlan& plan_;
    const ClashOptions& options_;
    StoreFile& store_;
    StoreClashReport result_; ///< the clashes' parts are indices in the plan's until finish()
    std::map<std::uint32_t, Part> named_; ///< parts that clash
};

} // namespace abut
