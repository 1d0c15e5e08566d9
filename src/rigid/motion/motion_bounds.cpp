#include "rigid/motion/motion_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// A factor that outweighs what the roundings below can add to a time.
constexpr double kShorter = 1 - 0x1p-40;
constexpr int kBoundRounds = 3; // more rounds gain little

} // namespace

double free_time(const Approach& x) {
    if (!(x.gap > 0))
        return 0;
    if (x.fastest <= 0 || (x.closing <= 0 && x.bend == 0))
        return kNever;
    // bend / 2 s^2 + closing s - gap = 0, solved by the form that does not cancel.
    const double root = std::sqrt(x.closing * x.closing + 2 * x.bend * x.gap);
    const double second_order =
        x.closing > 0 ? 2 * x.gap / (x.closing + root) : (root - x.closing) / x.bend;
    return kShorter * std::max(second_order, x.gap / x.fastest);
}

double free_time(const Vec3& offset, const Vec3& velocity, double bend, double sum_of_radii,
                 double horizon) {
    const double r = sum_of_radii, distance = length(offset);
    if (!(distance > r))
        return 0;
    const double missing = (distance - r) * (distance + r), closing = dot(offset, velocity);
    const double speed_sq = length_sq(velocity), passing_sq = length_sq(cross(offset, velocity));
    // Up to time `end`, bend / 2 s^2 <= growth s. So balls that move straight and whose radii grow
    // by `growth` in sum enclose the balls. They meet where |offset + s velocity| = r + growth s.
    double proven = 0;
    for (int round = 0; round < kBoundRounds; ++round) {
        const double end = round == 0 ? horizon : std::min(horizon, 2 * proven);
        const double growth = 0.5 * bend * end;
        const double half_slope = closing - r * growth, square = speed_sq - growth * growth;
        // (half_slope^2 - square * missing), written as a difference of two squared lengths, which
        // is exact to rounding where the balls graze.
        const double discriminant = length_sq(r * velocity - growth * offset) - passing_sq;
        const bool never = square >= 0 && (half_slope >= 0 || discriminant < 0);
        const double root = std::sqrt(std::max(0.0, discriminant));
        // square s^2 + 2 half_slope s + missing = 0, solved by the form that does not cancel.
        const double meet =
            half_slope > 0 ? (half_slope + root) / -square : missing / (root - half_slope);
        const bool beyond = never || kShorter * meet >= end;
        if (beyond && end == horizon)
            return kNever;
        proven = std::max(proven, kShorter * (beyond ? end : meet));
    }
    return proven;
}

} // namespace abut
