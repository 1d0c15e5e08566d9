#pragma once

#include "math/vector.h"

#include <array>
#include <limits>

namespace abut {

/// Rounds to the nearest float not above, or not below, the number.
///
/// Not inline: where g++ 12 vectorises several calls side by side, it compares the numbers before
/// they are rounded.
float round_down(double v);
float round_up(double v);

/// Axis-aligned box in single precision. It encloses what it was fitted to, because every bound is
/// rounded outward.
struct Aabb {
    std::array<float, 3> lower{std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::infinity()};
    std::array<float, 3> upper{-std::numeric_limits<float>::infinity(),
                               -std::numeric_limits<float>::infinity(),
                               -std::numeric_limits<float>::infinity()};

    Aabb() = default;
    /// Encloses the box, enlarged by `margin` on every side.
    explicit Aabb(const Box3& box, double margin = 0)
        : lower{round_down(box.lower.x - margin), round_down(box.lower.y - margin),
                round_down(box.lower.z - margin)},
          upper{round_up(box.upper.x + margin), round_up(box.upper.y + margin),
                round_up(box.upper.z + margin)} {}

    void merge(const Aabb& other) {
        for (std::size_t i = 0; i < 3; ++i) {
            lower[i] = std::min(lower[i], other.lower[i]);
            upper[i] = std::max(upper[i], other.upper[i]);
        }
    }
    /// Half the surface area; 0 if the box is empty.
    [[nodiscard]] float half_area() const {
        const float x = upper[0] - lower[0], y = upper[1] - lower[1], z = upper[2] - lower[2];
        return x >= 0 ? x * y + y * z + z * x : 0;
    }
};

} // namespace abut
