#pragma once

#include <abut/robot.h>

#include <span>
#include <vector>

namespace abut {

/// Which variables place each joint of a robot.
struct JointVariables {
    std::vector<RobotVariable> variables;
    std::vector<std::uint32_t> first; ///< of each joint; for one that follows, of its source
};

JointVariables number_variables(const RobotDescription& robot);

/// Bounds of the motion assume values no larger than this, in radians or metres.
inline constexpr double kLargestValue = 1e9;

/// The sum of the sizes of both terms of a value that follows another joint, which bounds its
/// rounding. 0 for a joint that follows none.
///
/// In          first: of the joint, as in JointVariables.
double mimic_size(const RobotJoint& joint, std::uint32_t first,
                  std::span<const double> configuration);

/// Computes the place of every link, parents first. Positions follow from these transforms as
/// abut/types.h states.
///
/// In          a valid configuration.
void forward_kinematics(const RobotDescription& robot, const JointVariables& variables,
                        std::span<const double> configuration, std::vector<Transform>& links);

/// The rotation about a unit axis, followed by a translation.
///
/// Source      [Rodrigues].
Transform rotation_about(const Vec3& axis, double angle, const Vec3& shift);

/// Bounds of a joint's motion between two configurations, while every variable changes at a constant
/// rate in unit time.
struct JointMotion {
    double speed = 0; ///< of the child's origin relative to the parent; metres
    double turn = 0;  ///< angular speed, radians
    double reach = 0; ///< largest distance of the child's origin from the parent's origin
};
std::vector<JointMotion> joint_motions(const RobotDescription& robot,
                                       const JointVariables& variables,
                                       std::span<const double> from, std::span<const double> to);

} // namespace abut
