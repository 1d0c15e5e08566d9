#pragma once

#include <abut/world.h>

#include "world/narrow_phase/world_data.h"
#include "world/schedule/course.h"
#include "world/schedule/pair_estimate.h"

#include <cstdint>
#include <unordered_map>
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
    /// As World::advance. In: a valid time, here and below; the world's bodies are up to date.
    std::vector<BodyPair> advance(double time, const Progress& progress);
    /// As World::next_event. It improves the estimates that come first.
    double next_event();
    /// As World::time_to_collision.
    double time_to_collision(double limit, const Progress& progress);
    double time_to_collision(std::uint32_t a, std::uint32_t b);
    [[nodiscard]] const ScheduleCounters& counters() const { return counters_; }

private:
    /// A pair of overlapping swept boxes, or a free place for one.
    struct Pair {
        IndexPair bodies;
        double due = 0;
        bool alive = false;
        bool improved = false; ///< `due` is the best that can be proven at the last step
    };
    /// Outdated if the pair has another due time.
    struct Due {
        double time = 0;
        std::uint32_t pair = 0;
        bool operator<(const Due& other) const { return time > other.time; } // the earliest first
    };

    [[nodiscard]] bool takes_part(std::uint32_t body) const;
    [[nodiscard]] double chosen_horizon(double step) const;
    [[nodiscard]] PairNow pair_now(IndexPair pair) const;

    std::vector<std::uint32_t> follow_courses();
    void sweep(const std::vector<std::uint32_t>& strayed, double step);
    void follow_pairs(double begun_due);
    std::vector<std::uint32_t> take_due();
    void make_due(std::uint32_t pair, double time);
    [[nodiscard]] bool is_outdated(const Due& due) const;
    void take_first();
    void forget_outdated();
    std::vector<PairEstimate> estimates_of(const std::vector<std::uint32_t>& pairs, double step,
                                           const Progress& progress);
    void count_payment(Measurement measurement);
    void catch_up(double step);
    void set_swept_box(std::uint32_t body);
    void extend_horizon(double horizon);
    PairEstimate best_of_pair(IndexPair bodies, PairMemory& memory, double most);
    double first_due();
    bool improve_first();
    double free_until_horizon(double limit);

    const WorldData& world_;
    double now_ = 0;
    double step_ = 0;     ///< length of the last step that took time
    double horizon_ = -1; ///< the swept boxes are valid until this time
    std::vector<Course> courses_;
    std::vector<Box3> swept_;
    BroadPhase broad_phase_;
    std::vector<Pair> pairs_;
    std::vector<PairMemory> memories_;                          ///< one for each of pairs_
    std::vector<std::uint32_t> free_pairs_;                     ///< free places in pairs_
    std::unordered_map<std::uint64_t, std::uint32_t> place_of_; ///< in pairs_, by the bodies' key
    std::vector<Due> queue_;                                    ///< a heap
    /// Pairs that touched at the last step: always due, and not in the queue.
    std::vector<std::uint32_t> touching_;
    double paying_ = 1; ///< share of the late measurements of surfaces that saved their cost
    ScheduleCounters counters_;
};

} // namespace abut
