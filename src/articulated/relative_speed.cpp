#include "articulated/relative_speed.h"

#include "math/vector.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Bounds are enlarged by this share for each joint of the robot. It exceeds the rounding of their
/// sums, and by how much a frame and an axis that a robot may have stretch lengths.
constexpr double kSpeedShare = 2e-8;
/// Rounding of a link's place, as a share of the lengths from the root to it: some products and
/// sums for each joint, each to 2^-53.
constexpr double kPlaceShare = 1e-13;
/// Rounding of an interpolated variable, as a share of its size.
constexpr double kVariableShare = 1e-15;

} // namespace

RelativeSpeed::RelativeSpeed(const RobotData& robot, std::span<const double> from,
                             std::span<const double> to)
    : robot_(robot), motions_(joint_motions(robot.description, robot.joints, from, to)),
      depth_(robot.description.links.size()) {
    double reach = 0;
    for (std::size_t i = 0; i < motions_.size(); ++i) {
        const RobotJoint& joint = robot.description.joints[i];
        depth_[joint.child] = depth_[joint.parent] + 1;
        reach += motions_[i].reach;
    }
    double size = 0;
    for (const RobotBody& body : robot.bodies)
        size = std::max(size, length(body.centre) + body.radius);
    double largest = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
        largest = std::max({largest, std::abs(from[i]), std::abs(to[i])});
    for (std::size_t i = 0; i < motions_.size(); ++i) {
        const RobotJoint& joint = robot.description.joints[i];
        const std::uint32_t first = robot.joints.first[i];
        largest = std::max({largest, mimic_size(joint, first, from), mimic_size(joint, first, to)});
    }
    rounding_ = (kPlaceShare + kVariableShare * largest) *
                (1 + static_cast<double>(motions_.size())) * (reach + size);
}

double RelativeSpeed::seen_from(const RobotBody& body, std::uint32_t other) const {
    // `arm` bounds the distance of the body's points from the origin of the link that the walk has
    // come to. A joint turns its child about the child's origin.
    double arm = length(body.centre) + body.radius;
    double speed = 0;
    std::vector<std::uint32_t> down; // joints between the common link and `other`
    std::uint32_t up = body.owner;
    while (up != other) {
        if (depth_[up] >= depth_[other]) {
            const std::uint32_t joint = robot_.joint_above[up];
            speed += motions_[joint].speed + motions_[joint].turn * arm;
            arm += motions_[joint].reach;
            up = robot_.description.joints[joint].parent;
        } else {
            down.push_back(robot_.joint_above[other]);
            other = robot_.description.joints[down.back()].parent;
        }
    }
    for (auto joint = down.rbegin(); joint != down.rend(); ++joint) {
        arm += motions_[*joint].reach;
        speed += motions_[*joint].speed + motions_[*joint].turn * arm;
    }
    return speed * (1 + kSpeedShare * static_cast<double>(1 + motions_.size()));
}

double RelativeSpeed::bound(const QueryBodies& bodies, const BodyTest& test) const {
    const RobotBody& a = bodies[test.a];
    const RobotBody& b = bodies[test.b];
    if (bodies.is_obstacle(test.b))
        return seen_from(a, robot_.description.root);
    return std::min(seen_from(a, b.owner), seen_from(b, a.owner));
}

} // namespace abut
