#pragma once

#include "math/vector.h"

/// For how long two moving sets stay apart: the inequalities that the time of impact rests on.
/// docs/time-of-impact.md derives them.
///
/// All lengths are in one frame; times count from now. A result is 0 where nothing is proven,
/// infinite where they never meet.
namespace abut {

/// ImpactOptions::tolerance where none is given, of the larger model's diagonal.
inline constexpr double kImpactTolerance = 1e-6;

/// Bounds that hold up to a horizon are used for at most so many radians of turn within it. Speeds
/// relative to a body that turns grow by no more than the factor then, e^0.26, beside what other
/// motion adds.
inline constexpr double kHorizonTurn = 0.26, kHorizonGrowth = 1.3;

/// How sets approach along a fixed unit vector n: their gap along it is at least
///
///     gap - s closing - s^2 / 2 bend      and at least      gap - s fastest.
struct Approach {
    double gap = 0;
    double closing = 0; ///< speed now; negative: they part
    double bend = 0;    ///< bound of the change of that speed, >= 0
    double fastest = 0; ///< bound of that speed at any time
};

/// The gap stays positive before the time returned.
double free_time(const Approach& approach);

/// The same for two balls; `offset` from centre to centre, `velocity` its derivative now, `bend`
/// a bound of its second derivative, up to the time `horizon`.
double free_time(const Vec3& offset, const Vec3& velocity, double bend, double sum_of_radii,
                 double horizon);

} // namespace abut
