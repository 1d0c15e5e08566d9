#pragma once

#include "rigid/motion/moving_pair.h"

#include <array>
#include <cstdint>

namespace abut {

/// How the axes move along which two nodes are compared. With a body that turns, all its points
/// stand still, however far apart they are: so the axes turn with the larger of two nodes.
enum class AxesTurn : std::uint8_t { none, with_own, with_other };

/// How the contents of two nodes move, along the axes of one node's frame, in single precision. The
/// axes stand still, or turn with one of the bodies; the origin goes straight on with the own
/// body's velocity there. The unit of time is a span of time, so that speeds are ways.
///
/// A point x of the own node has the velocity spin_own x x, one of the other has
/// velocity + spin_other x x. What else there is, is in `spread`: for the vector d from a point of
/// the own to one of the other, and 0 <= s <= 1,
///
///     |n . (d(s) - d(0) - s d'(0))|  <=  s spread,
///
/// d and spins relative to axes that turn.
struct NodeMotion {
    AxesTurn axes = AxesTurn::none;
    std::array<float, 3> velocity{}, spin_own{}, spin_other{};
    std::array<float, 3> turn_own{}, turn_other{}; ///< |n x spin|, n each axis
    std::array<float, 3> spread{};                 ///< along each axis
    float spread_any = 0;                          ///< along any direction of length 1
    float own_from_other = 1; ///< lengths of the other's tree in the own, at most
    bool turns = false;       ///< false: all spins are zero
};

/// In          duration: of the span. part: how large what is compared is, relative to the nodes;
///             it decides how the axes turn.
/// Accuracy    `spread` covers the bend of the ways, all rounding of speeds that are computed from
///             these numbers, and that of the motion in double precision.
NodeMotion motion_of(const FrameMotion& frame, double duration, const Node& own, const Node& other,
                     const FrameMap& own_from_other, double part);

} // namespace abut
