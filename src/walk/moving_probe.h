#pragma once

#include <abut/walk.h>

#include "rigid/motion/trajectory.h"
#include "walk/box_motion.h"
#include "walk/near_entry.h"
#include "walk/part_table.h"
#include "walk/probe.h"

#include <vector>

namespace abut {

/// A probe and its motion while the time goes from 0 to 1.
class MovingProbe {
public:
    /// In          probe: must outlive this.
    /// Errors      Error{bad_argument}, as for the queries of a walk.
    MovingProbe(const Probe& probe, const Transform& world_from_probe, const Vec3& translation);
    MovingProbe(const Probe& probe, const Motion& motion);
    MovingProbe(const MovingProbe&) = delete;
    MovingProbe& operator=(const MovingProbe&) = delete;

    [[nodiscard]] const PlacedProbe& placed() const { return placed_; } ///< at the start
    /// Boxes relative to the table that enclose the probe throughout its motion; none for an empty
    /// model.
    [[nodiscard]] std::vector<BoxMotion> boxes(const PartTable& table) const;
    /// The first contact with an entry up to a time; `time` of the result is 1 if there is none.
    [[nodiscard]] PartImpact contact(const NearEntry& entry, double until, bool may_touch_at_start,
                                     const WalkQuery& query, bool& meets) const;

private:
    const ProbeData& data_;
    Transform start_;
    PlacedProbe placed_;
    Trajectory trajectory_;
};

} // namespace abut
