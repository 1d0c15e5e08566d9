#include "world/solids/contact_candidate.h"

#include <cmath>

namespace abut {

ContactFrame::ContactFrame(const Vec3& origin_in_world, const Vec3& unit_normal)
    : origin(origin_in_world), normal(unit_normal) {
    // [Duff et al. 2017], without a square root.
    const Vec3& n = unit_normal;
    const double sign = std::copysign(1.0, n.z), p = -1 / (sign + n.z), q = n.x * n.y * p;
    across_x = {1 + sign * n.x * n.x * p, sign * q, -sign * n.x};
    across_y = {q, sign + n.y * n.y * p, -n.y};
}

ContactFrame ContactFrame::turned_round() const {
    ContactFrame turned;
    turned.origin = origin, turned.normal = -normal;
    turned.across_x = across_y, turned.across_y = across_x;
    return turned;
}

} // namespace abut
