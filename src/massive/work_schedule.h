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
    /// In          units: in an order in which each shares much with the one before. Both must outlive
    ///             the schedule.
    WorkSchedule(const StoredParts& stored, const std::vector<WorkUnit>& units,
                 std::size_t workers);

    /// The next piece of a worker, with what its run knows of the meshes' next uses; none if all
    /// have been handed out.
    std::optional<WorkPiece> next(std::size_t worker);

private:
    struct Run {
        std::size_t begin = 0, end = 0; ///< units that are not handed out yet
    };
    [[nodiscard]] std::uint64_t work_of(const Run& run) const {
        return work_before_[run.end] - work_before_[run.begin];
    }
    /// The first unit before which there is at least so much work.
    [[nodiscard]] std::size_t unit_after(std::uint64_t work) const;
    void take_over_half(Run& run);
    [[nodiscard]] std::uint32_t next_use(std::uint32_t mesh, const Run& run) const;

    const StoredParts& stored_;
    const std::vector<WorkUnit>& units_;
    std::vector<Run> runs_;                  ///< by worker
    std::vector<std::uint64_t> work_before_; ///< each unit, and the end
    std::vector<std::uint32_t> first_use_;   ///< by mesh, in uses_
    std::vector<std::uint32_t> uses_;        ///< units, ascending
};

} // namespace abut
