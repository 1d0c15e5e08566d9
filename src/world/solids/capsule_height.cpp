#include "world/solids/capsule_height.h"

#include <cmath>

namespace abut {

namespace {

/// The height at which a vertical line leaves a ball, times `sign`.
std::optional<double> ball_height(const Vec3& centre, double radius_sq, double x, double y,
                                  double sign) {
    const double dx = x - centre.x, dy = y - centre.y, room = radius_sq - (dx * dx + dy * dy);
    if (room < 0)
        return std::nullopt;
    return sign * centre.z + std::sqrt(room);
}

} // namespace

CapsuleSurface::CapsuleSurface(const Vec3& p, const Vec3& q, double radius)
    : p_(p), q_(q), axis_(q - p), radius_sq_(radius * radius),
      across_sq_(axis_.x * axis_.x + axis_.y * axis_.y), axis_sq_(across_sq_ + axis_.z * axis_.z) {
    if (across_sq_ > 0)
        part_ = 1 / across_sq_;
}

// A capsule is the union of balls around the points of its axis. The line leaves them last where the
// height is largest along the axis, as a concave function: beside the axis, as from the cylinder around the
// axis' line, or else at the end that is nearer to that place.
std::optional<double> CapsuleSurface::height(double x, double y, double sign) const {
    if (!(across_sq_ > 0))
        return ball_height(sign * p_.z > sign * q_.z ? p_ : q_, radius_sq_, x, y, sign);
    // With w = (x, y, p.z + z) - p and the axis d, the cylinder is |w|^2 - (w.d)^2 / d^2 = r^2:
    //     across^2 z^2 - 2 along d.z z + rest = 0
    const double dx = x - p_.x, dy = y - p_.y;
    const double along = dx * axis_.x + dy * axis_.y, aside = dx * axis_.y - dy * axis_.x;
    const double room = radius_sq_ * across_sq_ - aside * aside;
    if (room < 0)
        return std::nullopt;
    const double z = (along * axis_.z + sign * std::sqrt(axis_sq_ * room)) * part_;
    const double place = along + z * axis_.z; // along the axis, in parts of axis_sq
    if (place < 0)
        return ball_height(p_, radius_sq_, x, y, sign);
    if (place > axis_sq_)
        return ball_height(q_, radius_sq_, x, y, sign);
    return sign * (p_.z + z);
}

} // namespace abut
