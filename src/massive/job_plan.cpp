#include "massive/job_plan.h"

#include <abut/error.h>

#include "core/progress.h"
#include "massive/clash_identity.h"
#include "massive/unit_size.h"

#include <malloc.h>
#include <string>

namespace abut {

namespace {

/// For pairs and rows of the unit at hand.
constexpr std::uint64_t kLeastMemory = std::uint64_t{64} << 10;

std::uint64_t bytes_for_models(const StoredParts& parts, const std::vector<IndexPair>& pairs,
                               const OutOfCoreOptions& options, const std::string& store) {
    const std::uint64_t tables = parts.bytes() + pairs.capacity() * sizeof(IndexPair);
    if (options.memory < kLeastMemory + tables)
        throw Error(ErrorCode::bad_argument, store,
                    "needs more memory: " + std::to_string(((kLeastMemory + tables) >> 20) + 1) +
                        " MiB at least");
    return options.memory - tables;
}

} // namespace

JobPlan make_plan(StoreFile& store, const ClashOptions& options,
                  const OutOfCoreOptions& out_of_core, bool recorded) {
    require_tolerances(options);
    ProgressMeter progress(options.progress, "broad phase", 3);
    JobPlan plan;
    plan.stored = gather_parts(store, !options.rules.empty());
    progress.advance();
    std::vector<IndexPair> pairs = find_candidates(plan.stored, options);
    plan.candidates = pairs.size();
    progress.advance();
    if (recorded && out_of_core.keep)
        plan.record = JobRecord::open(store.path(), plan.stored, options, plan.candidates);
    if (plan.record != nullptr)
        pairs = plan.record->pairs_left(plan.stored, std::move(pairs));
    plan.budget = bytes_for_models(plan.stored, pairs, out_of_core, store.path());
    // One unit is tested while the next one's models come into memory.
    const std::size_t workers = out_of_core.crew == nullptr ? 1 : out_of_core.crew->size();
    const std::uint64_t unit = unit_budget(plan.stored, pairs, plan.budget / 2, workers);
    plan.units =
        make_work_units(plan.stored, std::move(pairs), unit, out_of_core.order, store.path());
    plan.units = split_long_units(std::move(plan.units), plan.stored, workers);
    if (plan.record != nullptr)
        plan.record->plan(plan.stored, plan.units);
    // What the broad phase and the partition needed is free for models, and not in small pieces.
    malloc_trim(0);
    progress.advance();
    return plan;
}

} // namespace abut
