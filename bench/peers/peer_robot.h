#pragma once

#include <abut/robot.h>

#include <memory>
#include <span>
#include <string>

namespace abut::bench {

/// The pairs of a robot's links, by another library.
class RobotPeer {
public:
    virtual ~RobotPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Returns whether any pair meets at these places of the links.
    virtual bool collide(std::span<const Transform> links) = 0;
    /// Returns the least distance of the pairs; 0 if one meets.
    virtual double distance(std::span<const Transform> links) = 0;
};

/// Null if the library is not installed.
std::unique_ptr<RobotPeer> make_fcl_robot(const Robot& robot);
std::unique_ptr<RobotPeer> make_bullet_robot(const Robot& robot);

} // namespace abut::bench
