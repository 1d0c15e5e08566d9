#pragma once

#include "math/vector.h"
#include "view/simplify/level_surface.h"

#include <cmath>

namespace abut {

/// Maps a direction to the octahedron |x| + |y| + |z| = 1, whose lower half is folded outward, so
/// that the square [-1, 1]^2 holds both. A zero vector becomes +z.
///
/// Accuracy    within 1 degree.
/// Source      [Meyer, Suessmuth, Sussner, Stamminger, Greiner 2010].
inline PackedNormal pack_normal(const Vec3& n) {
    const double sum = sum_of_sizes(n);
    if (!(sum > 0 && std::isfinite(sum)))
        return {0, 0};
    double x = n.x / sum, y = n.y / sum;
    if (n.z < 0) {
        const double folded = (1 - std::abs(y)) * (x >= 0 ? 1 : -1);
        y = (1 - std::abs(x)) * (y >= 0 ? 1 : -1);
        x = folded;
    }
    const auto step = [](double v) {
        return static_cast<std::int8_t>(std::lround(std::clamp(v, -1.0, 1.0) * 127));
    };
    return {step(x), step(y)};
}

/// The unit vector of a packed normal.
inline Vec3 unpack_normal(const PackedNormal& packed) {
    double x = packed[0] / 127.0, y = packed[1] / 127.0;
    const double z = 1 - std::abs(x) - std::abs(y);
    if (z < 0) {
        const double folded = (1 - std::abs(y)) * (x >= 0 ? 1 : -1);
        y = (1 - std::abs(x)) * (y >= 0 ? 1 : -1);
        x = folded;
    }
    return normalized_or_zero({x, y, z});
}

} // namespace abut
