#pragma once

#include "rigid/manifold/triangle_meeting.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Finds which meetings belong together, in memory that later calls use again.
///
/// Two meetings of one triangle belong together if their other triangles share a vertex. A region
/// then is a connected curve or area, perhaps together with others that pass through neighbouring
/// triangles. Pairs that are only near join no two regions that meet.
class MeetingRegions {
public:
    /// Sets the region of each meeting and sorts them by it, and within a region by pair. Returns
    /// the number of regions.
    ///
    /// Cost        expected linear.
    std::uint32_t group(TriangleMeetings& meetings);

private:
    struct Slot {
        std::uint64_t key = 0; ///< a triangle of one model, a vertex of the other
        std::uint32_t meeting = 0;
        std::uint32_t used_in = 0; ///< the pass that filled the slot
    };
    /// Keeps the order within a region.
    void sort_by_region(std::vector<TriangleMeeting>& meetings, std::uint32_t count);
    void begin_pass(std::size_t meetings);
    /// The first meeting of this pass that has the key: `meeting` if there is none yet.
    std::uint32_t first_with(std::uint64_t key, std::uint32_t meeting);

    std::vector<Slot> slots_;
    std::vector<std::uint32_t> next_; ///< where the next meeting of a region goes
    std::vector<TriangleMeeting> sorted_;
    std::uint32_t pass_ = 0;
};

/// Splits a region that bends around a hollow, where one normal cannot part the models: a ball in a
/// corner, a peg in a hole.
///
/// Returns the number of parts, at least 1; `part` then has the part of each meeting. One part has
/// normals of one side within about 60 degrees; parts that bulge towards the other model stay
/// together.
std::uint32_t split_where_hollow(std::span<const TriangleMeeting> region,
                                 std::vector<std::uint32_t>& part);

} // namespace abut
