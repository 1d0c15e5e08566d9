#pragma once

#include "geometry/rounded_box_distance.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace abut {

/// Which face of a box has its outward normal nearest to a direction, and the numbers of its
/// vertices and edges.
///
/// The vertex number has a bit for each axis, set on its positive side. An edge's number is 4 times
/// its axis plus the bits of the other two axes.
struct BoxFace {
    std::size_t k = 0;        ///< the axis of the normal
    bool positive = false;    ///< whether the normal is that axis, not its negative
    std::size_t u = 0, v = 0; ///< the other axes; u x v is along the outward normal
    std::uint32_t side = 0;   ///< the vertex number where both coordinates in the face are negative
    std::array<double, 3> along{}; ///< the direction along the box's axes

    BoxFace(const RoundedBox& box, const Vec3& direction) {
        for (std::size_t i = 0; i < 3; ++i) {
            along[i] = dot(direction, box.axis[i]);
            if (std::abs(along[i]) > std::abs(along[k]))
                k = i;
        }
        positive = along[k] > 0;
        side = positive && box.half[k] > 0 ? 1U << k : 0U;
        u = positive ? (k + 1) % 3 : (k + 2) % 3, v = 3 - k - u;
    }
    [[nodiscard]] Vec3 normal(const RoundedBox& box) const {
        return positive ? box.axis[k] : -box.axis[k];
    }
    [[nodiscard]] std::uint32_t bit_u() const { return 1U << u; }
    [[nodiscard]] std::uint32_t bit_v() const { return 1U << v; }
    /// The number of the edge along an axis at a vertex.
    static std::uint32_t edge(std::size_t axis, std::uint32_t vertex) {
        const std::uint32_t low = vertex & ((1U << axis) - 1), high = vertex >> (axis + 1) << axis;
        return static_cast<std::uint32_t>(4 * axis) + (low | high);
    }
};

} // namespace abut
