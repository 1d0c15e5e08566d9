#include "massive/job/job_plan.h"

#include <abut/error.h>

#include "clash/clash_identity.h"
#include "core/progress.h"
#include "massive/work/large_meshes.h"
#include "massive/work/unit_size.h"
#include "store/database/property_table.h"

#include <algorithm>
#include <malloc.h>
#include <string>

namespace abut {

namespace {

/// Least memory beside the tables, for the pairs and part rows of the current work unit.
constexpr std::uint64_t kLeastMemory = std::uint64_t{64} << 10;

/// Divisor of the memory: this share holds built hierarchies that wait to be stored. The
/// hierarchies of all models that fit into half of the memory need less.
constexpr std::uint64_t kHierarchiesShare = 64;

[[noreturn]] void fail_for_memory(std::uint64_t least, const std::string& store) {
    throw Error(ErrorCode::bad_argument, store,
                "needs more memory: " + std::to_string((least >> 20) + 1) + " MiB at least");
}

/// Returns whether at least one pair has a part with a large mesh.
bool needs_large(const StoredParts& parts, const std::vector<IndexPair>& pairs) {
    return !parts.large.empty() &&
           std::any_of(pairs.begin(), pairs.end(), [&](const IndexPair& pair) {
               return parts.find_large(parts.parts[pair.a()].mesh) != nullptr ||
                      parts.find_large(parts.parts[pair.b()].mesh) != nullptr;
           });
}

std::uint64_t bytes_for_models(const JobPlan& plan, const std::vector<IndexPair>& pairs,
                               const OutOfCoreOptions& options, const std::string& store) {
    const std::uint64_t tables = plan.stored.bytes() + plan.rules->bytes() +
                                 pairs.capacity() * sizeof(IndexPair) + plan.hierarchies_room;
    if (options.memory < kLeastMemory + tables)
        fail_for_memory(kLeastMemory + tables, store);
    return options.memory - tables;
}

} // namespace

JobPlan make_plan(StoreFile& store, const ClashOptions& options,
                  const OutOfCoreOptions& out_of_core, bool recorded) {
    require_tolerances(options);
    ProgressMeter progress(options.progress, "broad phase", 3);
    JobPlan plan;
    auto rules = std::make_unique<RuleTable>(options);
    plan.stored = gather_parts(store, rules.get());
    rules->require_known([&] {
        return store.with_connection([](Database& database) { return property_names(database); });
    });
    plan.rules = std::move(rules);
    progress.advance();
    std::vector<IndexPair> pairs =
        find_candidates(plan.stored, *plan.rules, options, &plan.left_out);
    plan.candidates = pairs.size();
    for (const IndexPair& pair : pairs)
        plan.touch.add(plan.rules->precision(), pair.a(), pair.b());
    progress.advance();
    if (recorded && out_of_core.keep)
        plan.record = JobRecord::open(store.path(), plan.stored, options, plan.candidates);
    if (plan.record != nullptr)
        pairs = plan.record->pairs_left(plan.stored, std::move(pairs));
    // A crew stores no hierarchies, because its processes read the store without locks. The room is
    // set aside even without a record, so that the work units are the same in both cases.
    if (out_of_core.keep_hierarchies && out_of_core.crew == nullptr)
        plan.hierarchies_room = out_of_core.memory / kHierarchiesShare;
    plan.budget = bytes_for_models(plan, pairs, out_of_core, store.path());
    if (needs_large(plan.stored, pairs)) {
        plan.blocks_budget = plan.budget / 2;
        plan.budget -= plan.blocks_budget;
        if (const std::uint64_t least = least_for_blocks(plan.stored); plan.blocks_budget < least)
            fail_for_memory(out_of_core.memory + 2 * (least - plan.blocks_budget), store.path());
    }
    // One unit is tested while the models of the next one are read.
    const std::size_t workers = out_of_core.crew == nullptr ? 1 : out_of_core.crew->size();
    const std::uint64_t unit = unit_budget(plan.stored, pairs, plan.budget / 2, workers);
    plan.units =
        make_work_units(plan.stored, std::move(pairs), unit, out_of_core.order, store.path());
    plan.units = split_long_units(std::move(plan.units), plan.stored, workers);
    if (plan.record != nullptr)
        plan.record->plan(plan.stored, plan.units);
    else
        plan.hierarchies_room = 0;
    // Returns the memory that the broad phase and the partition freed to the system, so that the
    // models can use it without fragmentation.
    malloc_trim(0);
    progress.advance();
    return plan;
}

} // namespace abut
