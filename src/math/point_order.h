#pragma once

#include "math/vector.h"

#include <tuple>

namespace abut {

/// An order of points, so that equal ones can be found: by x, then y, then z.
inline bool is_before(const Vec3& p, const Vec3& q) {
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

} // namespace abut
