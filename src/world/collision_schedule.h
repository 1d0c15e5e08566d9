#pragma once

#include <abut/world.h>

#include "world/world_data.h"

#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

namespace abut {

/// When which pair of bodies must be looked at again: not before it can have met.
///
/// Up to a horizon, only pairs matter whose boxes, swept by all that the bounds allow, overlap; each of
/// these has a time at which it is due. Beyond it, boxes are swept anew.
class CollisionSchedule {
public:
    explicit CollisionSchedule(const WorldData& world);

    void set_speed(std::uint32_t body, const SpeedBounds& bounds);
    /// Finds everything anew in the next step: who may meet whom has changed.
    void forget() { broad_phase_.forget(), horizon_ = -1; }
    std::vector<BodyPair> advance(double time, const Progress& progress);
    [[nodiscard]] double next_event() const;
    [[nodiscard]] const ScheduleCounters& counters() const { return counters_; }

private:
    /// What is known of a body's motion.
    struct Course {
        double since = 0; ///< a time; the rest is of that time
        Vec3 origin;
        SpeedBounds bounds;
        std::uint32_t generation = 0;
        bool known = false; ///< false: its pairs are to be looked at
    };
    struct Due {
        double time = 0;
        IndexPair pair;
        bool operator<(const Due& other) const { // the first one on top
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
    double horizon_ = -1; ///< no body's swept box is valid beyond
    std::vector<Course> courses_;
    std::vector<Box3> swept_;
    BroadPhase broad_phase_;
    std::vector<double> due_;         ///< of the broad phase's pairs
    std::priority_queue<Due> queue_;  ///< also of times that `due_` does not hold any more
    std::vector<IndexPair> touching_; ///< at the last step: always due, and in no queue
    ScheduleCounters counters_;
};

} // namespace abut
