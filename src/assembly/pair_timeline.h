#pragma once

#include "assembly/motion_slices.h"
#include "assembly/time_search.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// An assembly that is ready for queries over time.
struct MovingBodies {
    const AssemblyKinematics& kinematics;
    std::vector<RobotBody> bodies; ///< of the parts that have triangles; owner: the part
    std::vector<TimeSlice> slices;
    double rounding = 0; ///< bounds the rounding errors of a gap, from those of the places
};

/// A slice in which a pair may come near, with a bound of the relative speed.
struct PairSlice {
    TimeSlice time;
    double speed = 0;
};

/// Follows one pair over time.
///
/// Time is scanned forwards. Where the pair is free, it advances by the gap over the speed, so that
/// it passes no contact. Where the pair is near or in contact, samples are at most a step apart. An
/// end is found backwards from the first free sample, in the same way.
class PairTimeline {
public:
    /// In          a, b: indices of bodies. slices: indices, ascending.
    PairTimeline(const MovingBodies& moving, std::uint32_t a, std::uint32_t b,
                 std::span<const std::uint32_t> slices, const MotionClashOptions& options);

    /// Returns the clash of the pair, if there is one.
    std::optional<MotionClash> run();
    [[nodiscard]] std::uint64_t steps() const { return steps_; }

private:
    struct Measured {
        double time = 0;
        double gap = 0, at_least = 0; ///< gap: infinite if it was not measured, because it is large
        Vec3 point_a, point_b;
    };
    /// The intervals in which the gap is at most a level.
    struct Level {
        double gap = 0;
        std::vector<MotionInterval> found;
        bool is_open = false;
        double last = 0; ///< the latest time at which the gap was at most the level
    };

    void place(double time);
    Measured measure(double time, double far);
    [[nodiscard]] double touch(const PairSlice& slice) const;
    /// The time from one sample to the next where the pair is near or in contact.
    [[nodiscard]] double near_step() const;
    void scan(const PairSlice& slice);
    void note(const Measured& at, const PairSlice& slice);
    void note(Level& level, const Measured& at, const PairSlice& slice);
    double find_end(Level& level, Measured free, const PairSlice& slice);
    void close(Level& level, double time);
    [[nodiscard]] double way_between(double from, double to) const;

    MotionClash clash();
    void find_proofs(MotionClash& clash);
    void search_approaches();
    void find_least_gap(MotionClash& clash);
    void find_depth(MotionClash& clash);

    const MovingBodies& moving_;
    const RobotBody& a_;
    const RobotBody& b_;
    const MotionClashOptions& options_;
    double step_ = 0;
    std::vector<PairSlice> slices_;
    std::vector<std::uint32_t> needed_;
    std::vector<Transform> displacements_;
    Transform place_a_, place_b_;
    WarmStart warm_start_;
    Level contacts_, approaches_;
    std::vector<TimeValue> samples_; ///< where the pair is near or in contact
    TimeValue least_;                ///< the least gap in all approaches, and its bound
    std::uint64_t steps_ = 0;
};

} // namespace abut
