#pragma once

#include <abut/convex.h>

#include "math/vector.h"

#include <array>
#include <cstdint>
#include <limits>

namespace abut {

/// A triangle of a growing boundary (growing_boundary-inl.h), counter-clockwise as seen from outside.
struct BoundaryFace {
    BoundaryFace() {} // Not zeroed as a whole: it is written field by field.

    std::array<std::uint32_t, 3> corners;
    std::uint32_t gone;
    std::array<DifferencePolytope::Side, 3> across; ///< across[k]: beyond the edge from corner k
    Vec3 normal;                                    ///< of any length
    double height;                                  ///< of the plane along the normal
    double slack;                                   ///< height that is rounding
    double offset_sq; ///< the plane's distance from the origin, times its size

    [[nodiscard]] bool alive() const { return gone == 0; }
    /// It is never the nearest then.
    void remove() { gone = 1, offset_sq = std::numeric_limits<double>::infinity(); }
};

} // namespace abut
