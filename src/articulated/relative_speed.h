#pragma once

#include "articulated/placed_bodies.h"

#include <span>
#include <vector>

namespace abut {

/// Bounds the speeds of links relative to each other during the motion from one configuration to
/// another in unit time.
class RelativeSpeed {
public:
    RelativeSpeed(const RobotData& robot, std::span<const double> from, std::span<const double> to);

    /// A bound of the speed of any point of one body in the frame of the other. An obstacle stands
    /// still in the frame of the root. 0 only if the bodies do not move relative to each other.
    [[nodiscard]] double bound(const QueryBodies& bodies, const BodyTest& test) const;
    /// A bound of the rounding errors of a distance, from those of the links' places.
    [[nodiscard]] double rounding() const { return rounding_; }

private:
    /// Bounds the speed of points of the ball around `body`, in the frame of link `other`.
    [[nodiscard]] double seen_from(const RobotBody& body, std::uint32_t other) const;

    const RobotData& robot_;
    std::vector<JointMotion> motions_;
    std::vector<std::uint32_t> depth_; ///< number of joints above each link
    double rounding_ = 0;
};

} // namespace abut
