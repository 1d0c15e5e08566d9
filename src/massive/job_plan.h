#pragma once

#include <abut/store_clash.h>

#include "massive/job_record.h"
#include "massive/stored_parts.h"
#include "massive/work_units.h"
#include "store/store_file.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace abut {

/// What a job out of core compares, and in which order.
struct JobPlan {
    StoredParts stored;
    std::vector<WorkUnit> units;
    std::uint64_t candidates = 0;
    std::uint64_t budget = 0;           ///< bytes of models: of a unit and of the next one
    std::uint64_t blocks_budget = 0;    ///< bytes of blocks of large meshes
    std::uint64_t hierarchies_room = 0; ///< bytes of hierarchies that wait to be kept
    std::unique_ptr<JobRecord> record;  ///< may be none
};

/// In          recorded: what the store knows of this job counts, and it is to be kept there.
/// Errors      as find_clashes of a store.
JobPlan make_plan(StoreFile& store, const ClashOptions& options,
                  const OutOfCoreOptions& out_of_core, bool recorded);

} // namespace abut
