#pragma once

#include <abut/robot_description.h>

#include <optional>
#include <stdexcept>
#include <string>

namespace abut {

/// Joints that make no tree. `joint` is the index of the one at fault, in the order given.
struct JointFault : std::runtime_error {
    JointFault(std::optional<std::size_t> at, const std::string& what)
        : std::runtime_error(what), joint(at) {}
    std::optional<std::size_t> joint;
};

/// Sorts the joints of a robot, parents first and else in the given order, and finds its root.
/// Updates the indices of mimic joints.
///
/// Errors      JointFault if a link has two parents, if joints form a cycle, or if links are not
///             connected.
void sort_joints(RobotDescription& robot);

} // namespace abut
