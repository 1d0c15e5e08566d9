#pragma once

#include <abut/clash.h>
#include <abut/scene.h>
#include <abut/store_clash.h>

#include "clash/rules/rule_table.h"
#include "massive/work/stored_parts.h"
#include "massive/work/work_units.h"
#include "store/database/hierarchy_table.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// A task: a work unit as it is sent to a worker. The worker needs the store but no tables of
/// parts.
struct Task {
    struct MeshUse {
        std::int64_t mesh = 0;      ///< row in the store
        std::uint64_t bytes = 0;    ///< estimated size of its Model
        std::uint32_t next_use = 0; ///< next unit of this worker that needs it, or kNoUse
    };
    struct PartUse {
        std::int64_t row = 0;    ///< row in the store
        std::uint32_t mesh = 0;  ///< index in `meshes`, or meshes.size() + index in `large`
        std::uint32_t model = 0; ///< index in the store's models
    };
    struct Pair {
        std::uint32_t a = 0, b = 0;     ///< indices in parts
        std::uint32_t terms = 0;        ///< index in terms
        std::uint32_t unused = 0;       ///< so that a pair has no padding
        double touch = 0, rounding = 0; ///< take the place of the terms' own
    };
    /// How pairs are tested and reported.
    struct Terms {
        PairTerms numbers; ///< without the rule; touch and rounding are those of each pair
        std::string rule, severity;
    };
    static constexpr std::uint32_t kNoUse = UINT32_MAX;

    std::uint32_t unit = 0; ///< index in the plan's units
    bool alone = false;     ///< no other task fits into the memory beside this one
    std::vector<MeshUse> meshes;
    std::vector<std::int64_t>
        large; ///< rows of large meshes, whose blocks are read during the test
    std::vector<PartUse> parts;
    std::vector<Pair> pairs; ///< in the order of the unit
    std::vector<Terms> terms;
    /// Indices of the pairs that have a large mesh, in an order in which neighbouring pairs follow
    /// each other.
    std::vector<std::uint32_t> large_pairs;
};

/// Makes the task of a work unit. All next uses are kNoUse; the caller fills them in.
///
/// In          rules: of the stored parts; null if the pairs are not to be tested.
Task make_task(const StoredParts& stored, const std::vector<WorkUnit>& units, std::size_t unit,
               const RuleTable* rules);

/// The result of one task.
struct TaskResult {
    struct Found {
        std::uint32_t pair = 0;          ///< index in the task's pairs
        Clash clash;                     ///< without model and part
        std::optional<LeftOut> left_out; ///< why the report does not have it
    };
    struct Named {
        std::int64_t row = 0; ///< row in the store
        Part part;            ///< id, name and type
    };

    std::uint32_t unit = 0;
    std::uint32_t from = 0;     ///< rank of the worker; the receiver fills it in
    std::uint64_t pairs = 0;    ///< number of pairs tested
    std::vector<Found> clashes; ///< in the order of the pairs
    std::vector<Named> named;   ///< the parts that clash in the report, each once
    /// Hierarchies that were built for this task or the next, to be stored. They are not sent to
    /// another process.
    std::vector<HierarchyRow> hierarchies;
    OutOfCoreCounters::Worker worker; ///< counters of the worker so far, without units and pairs
};

} // namespace abut
