#include "world/contacts/capsule_height.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Takes the larger height.
void raise(std::optional<double>& height, double other) {
    height = height ? std::max(*height, other) : other;
}

} // namespace

// A capsule is the union of two balls and a cylinder.
std::optional<double> capsule_height(const Vec3& p, const Vec3& q, double radius, double x,
                                     double y, double sign) {
    std::optional<double> height;
    const double radius_sq = radius * radius;
    for (const Vec3& end : {p, q}) {
        const double dx = x - end.x, dy = y - end.y, room = radius_sq - (dx * dx + dy * dy);
        if (room >= 0)
            raise(height, sign * end.z + std::sqrt(room));
    }
    // With w = (x, y, p.z + z) - p and the axis d, the cylinder is |w|^2 - (w.d)^2 / d^2 = r^2:
    //     flat z^2 - 2 tilt z + rest = 0
    const Vec3 d = q - p;
    const double across_sq = d.x * d.x + d.y * d.y, axis_sq = across_sq + d.z * d.z;
    if (!(across_sq > 0))
        return height;
    const double dx = x - p.x, dy = y - p.y;
    const double along = dx * d.x + dy * d.y, aside = dx * d.y - dy * d.x;
    const double flat = across_sq / axis_sq, tilt = along * d.z / axis_sq;
    // The discriminant is (r^2 - aside^2 / across^2) times flat.
    const double room = radius_sq - aside * aside / across_sq;
    if (room < 0)
        return height;
    const double z = (tilt + sign * std::sqrt(flat * room)) / flat;
    const double t = (along + z * d.z) / axis_sq;
    if (t >= 0 && t <= 1)
        raise(height, sign * (p.z + z));
    return height;
}

} // namespace abut
