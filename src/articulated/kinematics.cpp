#include "articulated/kinematics.h"

#include "math/transform.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

constexpr std::array kPlanarNames{"/x", "/y", "/r"};
constexpr std::array kFloatingNames{"/x", "/y", "/z", "/rx", "/ry", "/rz"};

const char* variable_suffix(JointType type, std::size_t index) {
    if (type == JointType::planar)
        return kPlanarNames.at(index);
    if (type == JointType::floating)
        return kFloatingNames.at(index);
    return "";
}

bool is_angle(JointType type, std::size_t index) {
    switch (type) {
    case JointType::planar:
        return index == 2;
    case JointType::floating:
        return index >= 3;
    default:
        return type != JointType::prismatic;
    }
}

/// The two directions of a planar joint's plane; with the axis they are right-handed.
std::array<Vec3, 2> plane_directions(const Vec3& axis) {
    const Vec3 first = perpendicular(axis);
    return {first, cross(axis, first)};
}

/// The motion of a joint with these values, in the joint's frame.
Transform joint_transform(const RobotJoint& joint, std::span<const double> q) {
    switch (joint.type) {
    case JointType::fixed:
        return {};
    case JointType::prismatic:
        return rotation_about(joint.axis, 0, q[0] * joint.axis);
    case JointType::planar: {
        const auto [x, y] = plane_directions(joint.axis);
        return rotation_about(joint.axis, q[2], q[0] * x + q[1] * y);
    }
    case JointType::floating: {
        const Vec3 turn{q[3], q[4], q[5]};
        return rotation_about(normalized_or_zero(turn), length(turn), {q[0], q[1], q[2]});
    }
    default:
        return rotation_about(joint.axis, q[0], {});
    }
}

/// The values of a joint in a configuration. A joint that follows another one has one value.
class JointValues {
public:
    JointValues(const RobotJoint& joint, std::uint32_t first, std::span<const double> configuration)
        : values_(configuration.subspan(first, variables_of(joint.type))) {
        if (joint.mimic) {
            own_ = joint.mimic->multiplier * values_[0] + joint.mimic->offset;
            values_ = {&own_, 1};
        }
    }
    JointValues(const JointValues&) = delete;
    JointValues& operator=(const JointValues&) = delete;
    [[nodiscard]] std::span<const double> values() const { return values_; }

private:
    std::span<const double> values_;
    double own_ = 0;
};

double change(std::span<const double> from, std::span<const double> to, std::size_t begin,
              std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i)
        sum += (to[i] - from[i]) * (to[i] - from[i]);
    return std::sqrt(sum);
}

double size_of(std::span<const double> values, std::size_t end) {
    double sum = 0;
    for (std::size_t i = 0; i < end; ++i)
        sum += values[i] * values[i];
    return std::sqrt(sum);
}

} // namespace

Transform rotation_about(const Vec3& u, double angle, const Vec3& shift) {
    const double s = std::sin(angle);
    const double h = std::sin(0.5 * angle);
    const double v = 2 * h * h; // 1 - cos(angle), without cancellation
    const double c = 1 - v;
    return Transform({c + v * u.x * u.x, v * u.x * u.y + s * u.z, v * u.x * u.z - s * u.y,
                      v * u.x * u.y - s * u.z, c + v * u.y * u.y, v * u.y * u.z + s * u.x,
                      v * u.x * u.z + s * u.y, v * u.y * u.z - s * u.x, c + v * u.z * u.z, //
                      shift.x, shift.y, shift.z});
}

JointVariables number_variables(const RobotDescription& robot) {
    JointVariables result;
    result.first.resize(robot.joints.size());
    for (std::uint32_t i = 0; i < robot.joints.size(); ++i) {
        const RobotJoint& joint = robot.joints[i];
        if (joint.mimic)
            continue;
        result.first[i] = static_cast<std::uint32_t>(result.variables.size());
        for (std::size_t k = 0; k < variables_of(joint.type); ++k)
            result.variables.push_back({joint.name + variable_suffix(joint.type, k), i,
                                        joint.limits, is_angle(joint.type, k)});
    }
    for (std::uint32_t i = 0; i < robot.joints.size(); ++i)
        if (robot.joints[i].mimic)
            result.first[i] = result.first[robot.joints[i].mimic->joint];
    return result;
}

double mimic_size(const RobotJoint& joint, std::uint32_t first,
                  std::span<const double> configuration) {
    if (!joint.mimic)
        return 0;
    return std::abs(joint.mimic->multiplier * configuration[first]) + std::abs(joint.mimic->offset);
}

void forward_kinematics(const RobotDescription& robot, const JointVariables& variables,
                        std::span<const double> configuration, std::vector<Transform>& links) {
    links.resize(robot.links.size());
    links[robot.root] = {};
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
        const RobotJoint& joint = robot.joints[i];
        const Transform place = compose(links[joint.parent], joint.parent_from_joint);
        if (joint.type == JointType::fixed) {
            links[joint.child] = place;
            continue;
        }
        const JointValues values(joint, variables.first[i], configuration);
        links[joint.child] = compose(place, joint_transform(joint, values.values()));
    }
}

std::vector<JointMotion> joint_motions(const RobotDescription& robot,
                                       const JointVariables& variables,
                                       std::span<const double> from, std::span<const double> to) {
    std::vector<JointMotion> motions(robot.joints.size());
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
        const RobotJoint& joint = robot.joints[i];
        JointMotion& motion = motions[i];
        const auto& m = joint.parent_from_joint.m;
        motion.reach = length({m[9], m[10], m[11]});
        if (joint.type == JointType::fixed)
            continue;
        const JointValues first(joint, variables.first[i], from);
        const JointValues last(joint, variables.first[i], to);
        const auto a = first.values();
        const auto b = last.values();
        // The first values shift the child. The others turn it.
        const std::size_t shifts = joint.type == JointType::prismatic  ? 1
                                   : joint.type == JointType::planar   ? 2
                                   : joint.type == JointType::floating ? 3
                                                                       : 0;
        motion.speed = change(a, b, 0, shifts);
        motion.turn = change(a, b, shifts, a.size());
        motion.reach += std::max(size_of(a, shifts), size_of(b, shifts));
    }
    return motions;
}

} // namespace abut
