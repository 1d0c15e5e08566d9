#pragma once

#include <abut/store_clash.h>

#include "clash/touch_of_report.h"
#include "massive/record/job_record.h"
#include "massive/work/stored_parts.h"
#include "massive/work/work_units.h"
#include "store/database/store_file.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace abut {

/// The work of an out-of-core job: the parts, and the pairs to test in the order of work.
struct JobPlan {
    StoredParts stored;
    std::vector<WorkUnit> units;
    std::uint64_t candidates = 0;
    std::uint64_t budget = 0;           ///< bytes of models in memory: of one unit and the next
    std::uint64_t blocks_budget = 0;    ///< bytes of mesh blocks in memory
    std::uint64_t hierarchies_room = 0; ///< bytes of built hierarchies that wait to be stored
    std::unique_ptr<JobRecord> record;  ///< null if nothing is recorded
    std::unique_ptr<const RuleTable> rules;
    TouchOfReport touch;      ///< of all candidates
    LeftOutCounts left_out{}; ///< pairs that are not candidates
};

/// Finds the candidate pairs of a store and divides them into work units.
///
/// In          recorded: if the options allow it, reuse what the store knows of this job and record
///             the progress there.
/// Errors      those of find_clashes on a store.
JobPlan make_plan(StoreFile& store, const ClashOptions& options,
                  const OutOfCoreOptions& out_of_core, bool recorded);

} // namespace abut
