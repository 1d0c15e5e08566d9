#pragma once

#include "massive/work_piece.h"
#include "massive/work_units.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// Who does which units of work, and when. Each worker has a run of consecutive units, which share
/// meshes; one whose run has ended takes over the second half of the longest that is left.
class WorkSchedule {
public:
    /// In          units: in an order in which each shares much with the one before; meshes: how many
    ///             there are. The units must outlive the schedule.
    WorkSchedule(const std::vector<WorkUnit>& units, std::size_t meshes, std::size_t workers);

    /// The next unit of a worker; none if all have been handed out.
    std::optional<std::size_t> next(std::size_t worker);

    /// The next unit of the worker's run, after `unit`, that needs a mesh; kNoUse if none does.
    [[nodiscard]] std::uint32_t next_use(std::size_t worker, std::uint32_t mesh,
                                         std::size_t unit) const;

private:
    struct Run {
        std::size_t begin = 0, end = 0; ///< units that are not handed out yet
    };
    /// The first unit at which at least that share of all work lies behind.
    [[nodiscard]] std::size_t unit_at(std::uint64_t work) const;
    [[nodiscard]] std::uint64_t work_of(const Run& run) const {
        return done_by_[run.end] - done_by_[run.begin];
    }

    std::vector<Run> runs_;                ///< by worker
    std::vector<std::uint64_t> done_by_;   ///< work of all units before each
    std::vector<std::uint32_t> first_use_; ///< by mesh, in uses_
    std::vector<std::uint32_t> uses_;      ///< units, ascending
};

} // namespace abut
