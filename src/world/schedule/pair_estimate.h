#pragma once

#include "world/narrow_phase/narrow_phase.h"
#include "world/schedule/closing_time.h"

#include <cstdint>

namespace abut {

/// A distance of two bodies that was measured, and their places then.
struct KnownDistance {
    double at_least = 0; ///< 0: nothing was measured
    Transform a_from_b;
};

/// What the schedule remembers of a pair of bodies from one test to the next.
struct PairMemory {
    PairWarmStart warm_start;
    KnownDistance known;
    Vec3 direction;             ///< of the last plane between the bodies; zero: none known
    bool touched = false;       ///< at the last test
    bool measured = false;      ///< whether the distance of the surfaces was ever measured
    std::uint8_t idle = 0;      ///< tests until surfaces are measured again
    std::uint8_t idle_next = 0; ///< the same after the next measurement that does not pay
};

/// Two bodies, and how they may move relative to each other from now on.
struct PairNow { // NOLINT(cppcoreguidelines-pro-type-member-init): an aggregate of references
    PlacedBody a, b;
    const Box3 &box_a, &box_b;
    RelativeMotion motion;
};

/// Whether a distance of surfaces was measured, and saved as much as it cost.
enum class Measurement : std::uint8_t { none, wasted, paid };

struct PairEstimate {
    bool touch = false;
    bool measured = false; ///< whether surfaces or solids were measured, or tested for contact
    double free = 0;       ///< the bodies cannot begin to touch before this time has passed
    Measurement measurement = Measurement::none;
};

/// Tells whether two bodies touch now, and bounds when they may meet. Bounds are tried in the order
/// of their cost: enclosing balls and boxes, the last measured distance less what the bodies have
/// moved since, a plane between the bodies, the distance of their surfaces. The first that proves the
/// bodies apart ends the search; the last measured distance does so only if it leaves more than a
/// step free.
///
/// In          step: the time until the next test. A distance of surfaces that hardly ever buys
///             more than a few steps is replaced by a test for contact; first_idle: so is the first
///             one of a pair, so often.
PairEstimate estimate(const PairNow& pair, PairMemory& memory, double step,
                      std::uint8_t first_idle);

/// As `estimate`, with the latest time that all bounds together prove. It takes an exact distance.
PairEstimate best_estimate(const PairNow& pair, PairMemory& memory);

} // namespace abut
