#pragma once

#include <abut/world.h>

#include "world/narrow_phase/world_data.h"

#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

namespace abut {

/// Schedules when each pair of bodies must be tested again: not before it may have met.
///
/// Each body's box is swept by all the motion that its bounds allow until a horizon. Until then
/// only pairs of overlapping swept boxes matter, and each has a time at which it is due. After the
/// horizon, the boxes are swept anew.
class CollisionSchedule {
public:
    explicit CollisionSchedule(const WorldData& world);

    void set_speed(std::uint32_t body, const SpeedBounds& bounds);
    /// The next step finds all pairs anew, because the rules about which bodies may meet have
    /// changed.
    void forget() { broad_phase_.forget(), horizon_ = -1; }
    std::vector<BodyPair> advance(double time, const Progress& progress);
    [[nodiscard]] double next_event() const;
    [[nodiscard]] const ScheduleCounters& counters() const { return counters_; }

private:
    /// The known motion of a body.
    struct Course {
        double since = 0; ///< time to which the other members refer
        Vec3 origin;
        SpeedBounds bounds;
        std::uint32_t generation = 0;
        bool known = false; ///< false: its pairs must be tested
    };
    struct Due {
        double time = 0;
        IndexPair pair;
        bool operator<(const Due& other) const { // the earliest pair comes first
            return time != other.time ? time > other.time : other.pair < pair;
        }
    };

    [[nodiscard]] Vec3 origin_of(std::uint32_t body) const;
    [[nodiscard]] bool takes_part(std::uint32_t body) const;
    [[nodiscard]] bool keeps_course(std::uint32_t body) const;
    [[nodiscard]] Box3 swept_box(std::uint32_t body) const;
    [[nodiscard]] double chosen_horizon(double step) const;
    [[nodiscard]] double reach_of(std::uint32_t body) const;
    [[nodiscard]] double time_to_collision(IndexPair pair, double distance) const;

    std::vector<std::uint32_t> follow_courses();
    void sweep(const std::vector<std::uint32_t>& strayed, double step);
    std::vector<IndexPair> take_due();
    void make_due(std::size_t pair, double time);
    [[nodiscard]] std::vector<double> distances_of(const std::vector<std::size_t>& pairs,
                                                   const Progress& progress) const;

    const WorldData& world_;
    double now_ = 0;
    double horizon_ = -1; ///< the swept boxes are valid until this time
    std::vector<Course> courses_;
    std::vector<Box3> swept_;
    BroadPhase broad_phase_;
    std::vector<double> due_;         ///< one for each pair of the broad phase
    std::priority_queue<Due> queue_;  ///< may hold outdated times that `due_` no longer has
    std::vector<IndexPair> touching_; ///< pairs that touched at the last step: always due, and not
                                      ///< in the queue
    ScheduleCounters counters_;
};

} // namespace abut
