#include "articulated/joint_order.h"

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// The one link without a parent.
std::uint32_t root_link(const RobotDescription& robot,
                        const std::vector<std::optional<std::size_t>>& joint_above) {
    std::optional<std::uint32_t> root;
    for (std::uint32_t link = 0; link < robot.links.size(); ++link) {
        if (joint_above[link])
            continue;
        if (root)
            throw JointFault({}, "no joint connects the links '" + robot.links[*root].name +
                                     "' and '" + robot.links[link].name + "'");
        root = link;
    }
    if (!root)
        throw JointFault(joint_above[0],
                         "the joints form a cycle through link '" + robot.links[0].name + "'");
    return *root;
}

} // namespace

void sort_joints(RobotDescription& robot) {
    std::vector<std::optional<std::size_t>> joint_above(robot.links.size());
    std::vector<std::vector<std::size_t>> joints_below(robot.links.size());
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
        const RobotJoint& joint = robot.joints[i];
        if (joint_above[joint.child])
            throw JointFault(i, "the link '" + robot.links[joint.child].name +
                                    "' has two parents, by the joints '" +
                                    robot.joints[*joint_above[joint.child]].name + "' and '" +
                                    joint.name + "'");
        joint_above[joint.child] = i;
        joints_below[joint.parent].push_back(i);
    }
    robot.root = root_link(robot, joint_above);
    // The next joint is the first one, in the given order, whose parent has been reached.
    std::vector<std::size_t> order;
    std::set<std::size_t> next(joints_below[robot.root].begin(), joints_below[robot.root].end());
    while (!next.empty()) {
        const std::size_t i = *next.begin();
        next.erase(next.begin());
        order.push_back(i);
        const auto& below = joints_below[robot.joints[i].child];
        next.insert(below.begin(), below.end());
    }
    if (order.size() < robot.joints.size()) {
        std::vector<bool> reached(robot.joints.size());
        for (const std::size_t i : order)
            reached[i] = true;
        std::size_t left = 0;
        while (reached[left])
            ++left;
        throw JointFault(left, "the joint '" + robot.joints[left].name + "' is part of a cycle");
    }
    std::vector<std::uint32_t> place(order.size());
    std::vector<RobotJoint> sorted;
    for (const std::size_t i : order) {
        place[i] = static_cast<std::uint32_t>(sorted.size());
        sorted.push_back(std::move(robot.joints[i]));
    }
    for (RobotJoint& joint : sorted)
        if (joint.mimic)
            joint.mimic->joint = place[joint.mimic->joint];
    robot.joints = std::move(sorted);
}

} // namespace abut
