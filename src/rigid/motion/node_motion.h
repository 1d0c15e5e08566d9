#pragma once

#include "rigid/motion/moving_pair.h"

#include <array>
#include <cstdint>

namespace abut {

/// The motion of the axes along which two nodes are compared. In the frame of a turning body all
/// its points stand still, however far apart they are, so the axes turn with the body of the larger
/// node.
enum class AxesTurn : std::uint8_t { none, with_own, with_other };

/// How the contents of two nodes move, along the axes of one node's frame, in single precision. The
/// axes stand still, or turn with one of the bodies; the origin moves on straight with the own
/// body's velocity there. The unit of time is the span, so that a speed is the path length in it.
///
/// A point x of the own node has the velocity spin_own x x; one of the other node has
/// velocity + spin_other x x. `spread` covers the rest: for the vector d from a point of the own
/// node to one of the other, and 0 <= s <= 1,
///
///     |n . (d(s) - d(0) - s d'(0))|  <=  s spread,
///
/// where d and the spins are relative to axes that may turn.
struct NodeMotion {
    AxesTurn axes = AxesTurn::none;
    std::array<float, 3> velocity{}, spin_own{}, spin_other{};
    std::array<float, 3> turn_own{}, turn_other{}; ///< |n x spin| for each axis n
    std::array<float, 3> spread{};                 ///< along each axis
    float spread_any = 0;                          ///< along any direction of length 1
    /// Upper bound of the length of the other tree's unit in the own tree.
    float own_from_other = 1;
    bool turns = false; ///< false: all spins are zero
};

/// In          duration: of the span. part: the size of what is compared, relative to the nodes; it
///             decides how the axes turn.
/// Accuracy    `spread` covers the curvature of the paths, all rounding of speeds that are computed
///             from these numbers, and that of the motion in double precision.
NodeMotion motion_of(const FrameMotion& frame, double duration, const Node& own, const Node& other,
                     const FrameMap& own_from_other, double part);

} // namespace abut
