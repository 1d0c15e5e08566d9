#pragma once

#include <abut/convex.h>

#include "math/vector.h"

#include <array>
#include <cstdint>
#include <limits>

namespace abut {

/// A triangle of a growing boundary (growing_boundary-inl.h), counter-clockwise seen from outside.
struct BoundaryFace {
    BoundaryFace() {} // Leaves members unset: they are written one by one.

    std::array<std::uint32_t, 3> corners;
    std::uint32_t gone;
    std::array<DifferencePolytope::Side, 3> across; ///< across[k]: beyond the edge from corner k
    Vec3 normal;                                    ///< of any length
    double height;                                  ///< normal . p for each point p of the plane
    double slack;     ///< heights above the plane that may be rounding
    double offset_sq; ///< the plane's signed squared distance

    [[nodiscard]] bool alive() const { return gone == 0; }
    /// Removes the face; its infinite offset keeps it from being the nearest.
    void remove() { gone = 1, offset_sq = std::numeric_limits<double>::infinity(); }
};

} // namespace abut
