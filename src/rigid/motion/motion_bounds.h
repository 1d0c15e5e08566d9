#pragma once

#include "math/vector.h"

/// How long two moving sets stay apart: the inequalities on which the time of impact rests.
/// docs/motion-bounds.md derives them.
///
/// All lengths are in one frame; times count from now. A result is 0 if nothing is proven, and
/// infinite if the sets never meet.
namespace abut {

/// The default of ImpactOptions::absolute_error, as a share of the smaller model's diagonal.
inline constexpr double kImpactTolerance = 1e-6;

/// Bounds with a horizon are used only for a turn of at most kHorizonTurn radians within it. Speeds
/// relative to a turning body then grow by at most e^0.26, beside what other motion adds.
inline constexpr double kHorizonTurn = 0.26, kHorizonGrowth = 1.3;

/// The approach of two sets along a fixed unit vector n. Their gap along n is at least
///
///     gap - s closing - s^2 / 2 bend      and at least      gap - s fastest.
struct Approach {
    double gap = 0;
    double closing = 0; ///< speed now; negative: the sets part
    double bend = 0;    ///< bound of the change of the speed, >= 0
    double fastest = 0; ///< bound of the speed at any time
};

/// A time before which the gap stays positive.
double free_time(const Approach& approach);

/// A time before which two balls stay apart. `offset` runs from centre to centre, `velocity` is its
/// derivative now, and `bend` bounds its second derivative, up to the time `horizon`.
double free_time(const Vec3& offset, const Vec3& velocity, double bend, double sum_of_radii,
                 double horizon);

} // namespace abut
