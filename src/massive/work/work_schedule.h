#pragma once

#include "massive/work/task.h"
#include "massive/work/work_units.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// Distributes work units to workers. Each worker has a run of consecutive units, which share
/// meshes. A worker whose run has ended takes over the second half of the longest run that is left.
class WorkSchedule {
public:
    /// In          units: in an order in which each unit shares many meshes with the one before.
    ///             rules: as make_task. stored, units, rules: must outlive the schedule.
    WorkSchedule(const StoredParts& stored, const std::vector<WorkUnit>& units, std::size_t workers,
                 const RuleTable* rules = nullptr);

    /// Returns the next task of a worker, with the next uses of its meshes within the worker's run.
    /// Returns none if all units have been handed out.
    std::optional<Task> next(std::size_t worker);

private:
    struct Run {
        std::size_t begin = 0, end = 0; ///< range of units not handed out yet
    };
    [[nodiscard]] std::uint64_t work_of(const Run& run) const {
        return work_before_[run.end] - work_before_[run.begin];
    }
    /// Returns the first unit such that the units before it cost at least `work` together.
    [[nodiscard]] std::size_t unit_after(std::uint64_t work) const;
    void take_over_half(Run& run);
    [[nodiscard]] std::uint32_t next_use(std::uint32_t mesh, const Run& run) const;

    const StoredParts& stored_;
    const std::vector<WorkUnit>& units_;
    const RuleTable* rules_;
    std::vector<Run> runs_;                  ///< by worker
    std::vector<std::uint64_t> work_before_; ///< cost of the units before each one
    std::vector<std::uint32_t> first_use_;   ///< by mesh: index of its first use in uses_
    std::vector<std::uint32_t> uses_;        ///< units that use a mesh, ascending for each mesh
};

} // namespace abut
