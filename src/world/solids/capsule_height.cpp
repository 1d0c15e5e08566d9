#include "world/solids/capsule_height.h"

#include <cmath>

namespace abut {

namespace {

/// The height at which a vertical line leaves a ball, times `sign`.
std::optional<double> ball_height(const Vec3& centre, double radius, double x, double y,
                                  double sign) {
    const double dx = x - centre.x, dy = y - centre.y, room = radius * radius - (dx * dx + dy * dy);
    if (room < 0)
        return std::nullopt;
    return sign * centre.z + std::sqrt(room);
}

} // namespace

// A capsule is the union of balls around the points of its axis. The line leaves them last where the
// height is largest along the axis, as a concave function: beside the axis, as from the cylinder around the
// axis' line, or else at the end that is nearer to that place.
std::optional<double> capsule_height(const Vec3& p, const Vec3& q, double radius, double x,
                                     double y, double sign) {
    const Vec3 d = q - p;
    const double across_sq = d.x * d.x + d.y * d.y;
    if (!(across_sq > 0))
        return ball_height(sign * p.z > sign * q.z ? p : q, radius, x, y, sign);
    // With w = (x, y, p.z + z) - p and the axis d, the cylinder is |w|^2 - (w.d)^2 / d^2 = r^2:
    //     across^2 z^2 - 2 along d.z z + rest = 0
    const double axis_sq = across_sq + d.z * d.z, dx = x - p.x, dy = y - p.y;
    const double along = dx * d.x + dy * d.y, aside = dx * d.y - dy * d.x;
    const double room = radius * radius * across_sq - aside * aside;
    if (room < 0)
        return std::nullopt;
    const double z = (along * d.z + sign * std::sqrt(axis_sq * room)) / across_sq;
    const double place = along + z * d.z; // along the axis, in parts of axis_sq
    if (place < 0)
        return ball_height(p, radius, x, y, sign);
    if (place > axis_sq)
        return ball_height(q, radius, x, y, sign);
    return sign * (p.z + z);
}

} // namespace abut
