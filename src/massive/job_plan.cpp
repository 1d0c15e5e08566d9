#include "massive/job_plan.h"

#include <abut/error.h>

#include "core/progress.h"
#include "massive/clash_identity.h"
#include "massive/large_meshes.h"

#include <algorithm>
#include <malloc.h>
#include <string>

namespace abut {

namespace {

/// For pairs and rows of the unit at hand.
constexpr std::uint64_t kLeastMemory = std::uint64_t{64} << 10;

[[noreturn]] void fail_for_memory(std::uint64_t least, const std::string& store) {
    throw Error(ErrorCode::bad_argument, store,
                "needs more memory: " + std::to_string((least >> 20) + 1) + " MiB at least");
}

/// Whether a pair has a large mesh.
bool needs_large(const StoredParts& parts, const std::vector<IndexPair>& pairs) {
    return !parts.large.empty() &&
           std::any_of(pairs.begin(), pairs.end(), [&](const IndexPair& pair) {
               return parts.find_large(parts.parts[pair.a()].mesh) != nullptr ||
                      parts.find_large(parts.parts[pair.b()].mesh) != nullptr;
           });
}

std::uint64_t bytes_for_models(const StoredParts& parts, const std::vector<IndexPair>& pairs,
                               const OutOfCoreOptions& options, const std::string& store) {
    const std::uint64_t tables = parts.bytes() + pairs.capacity() * sizeof(IndexPair);
    if (options.memory < kLeastMemory + tables)
        fail_for_memory(kLeastMemory + tables, store);
    return options.memory - tables;
}

/// What the answer depends on: the question and the parts.
Hash128 key_of(const StoredParts& stored, const ClashOptions& options) {
    Hasher hasher;
    for (const ModelRow& model : stored.models)
        hasher.add_value(model.checksum());
    hasher.add_value(question_hash(options));
    return hasher.value();
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
        plan.record =
            JobRecord::open(store.path(), {key_of(plan.stored, options), options, plan.candidates});
    if (plan.record != nullptr)
        if (auto left = plan.record->pairs_left())
            pairs = std::move(*left);
    plan.budget = bytes_for_models(plan.stored, pairs, out_of_core, store.path());
    if (needs_large(plan.stored, pairs)) {
        plan.blocks_budget = plan.budget / 2;
        plan.budget -= plan.blocks_budget;
        if (const std::uint64_t least = least_for_blocks(plan.stored); plan.blocks_budget < least)
            fail_for_memory(out_of_core.memory + 2 * (least - plan.blocks_budget), store.path());
    }
    // One unit is tested while the next one's models come into memory.
    plan.units = make_work_units(plan.stored, std::move(pairs), plan.budget / 2, out_of_core.order,
                                 store.path());
    if (plan.record != nullptr)
        plan.record->plan(plan.units);
    // What the broad phase and the partition needed is free for models, and not in small pieces.
    malloc_trim(0);
    progress.advance();
    return plan;
}

} // namespace abut
