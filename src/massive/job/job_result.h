#pragma once

#include <abut/scene.h>
#include <abut/store_clash.h>

#include "massive/job/job_plan.h"
#include "massive/work/task.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace abut {

/// Collects the results of a job, unit by unit. They are recorded in the store if the plan has a
/// record.
class JobResult {
public:
    /// In          plan, options, store: must outlive this object.
    JobResult(JobPlan& plan, const ClashOptions& options, StoreFile& store, std::size_t workers);

    /// Adds the clashes that the record already knows, found before the job was stopped or taken
    /// over from an earlier one.
    void recall();

    /// Adds the results of some tasks. When it returns they are recorded, at the cost of one
    /// commit.
    void take(std::vector<TaskResult> results);

    /// Ends the job and returns the report. Clashes are sorted by part; their parts are indices in
    /// the report's lists of clashing parts.
    StoreClashReport finish();

    [[nodiscard]] const OutOfCoreCounters& counters() const { return result_.counters; }

private:
    void add(TaskResult result);
    void sum_up_workers();
    void add_model(const ModelRow& row);
    /// Adds the properties of the listed parts and the relations between them.
    /// In          rows: those of the parts of each model
    void add_knowledge(std::span<const std::vector<std::int64_t>> rows);
    /// Sets what follows from the parts of a clash, which are indices in the plan's parts.
    void set_known(Clash& clash) const;
    void move_found();

    JobPlan& plan_;
    const ClashOptions& options_;
    StoreFile& store_;
    StoreClashReport result_;             ///< its clashes come with finish()
    std::vector<FoundClash> found_;       ///< parts are indices in the plan's parts
    std::map<std::uint32_t, Part> named_; ///< parts that clash, by index in the plan's parts
};

} // namespace abut
