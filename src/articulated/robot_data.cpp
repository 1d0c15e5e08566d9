#include "articulated/robot_data.h"

#include <abut/error.h>

#include "articulated/joint_order.h"
#include "core/arguments.h"
#include "core/parallel.h"
#include "math/transform.h"
#include "math/vector.h"
#include "mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <string>

namespace abut {

namespace {

/// By how much the columns of a joint's frame may differ from orthogonal unit vectors.
constexpr double kRigidError = 1e-9;
/// A radius is rounded up by this share: far more than the rounding of a few products.
constexpr double kRadiusShare = 1e-12;

void require_rigid(const RobotJoint& joint) {
    const auto& m = joint.parent_from_joint.m;
    const Vec3 columns[3]{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
    for (int i = 0; i < 3; ++i)
        for (int k = i; k < 3; ++k)
            require(std::abs(dot(columns[i], columns[k]) - (i == k ? 1 : 0)) <= kRigidError,
                    "the frame of joint '" + joint.name + "' is not a rotation and a translation");
    require(is_finite(Vec3{m[9], m[10], m[11]}),
            "the frame of joint '" + joint.name + "' is not finite");
}

void require_tree(const RobotDescription& robot) {
    require(!robot.links.empty() && robot.root < robot.links.size(), "the robot has no root link");
    std::vector<bool> placed(robot.links.size());
    placed[robot.root] = true;
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
        const RobotJoint& joint = robot.joints[i];
        require(joint.parent < placed.size() && joint.child < placed.size(),
                "joint '" + joint.name + "' names a link that is out of range");
        require(placed[joint.parent] && !placed[joint.child],
                "joint '" + joint.name + "' does not follow those above it, or makes a cycle");
        placed[joint.child] = true;
        require_rigid(joint);
        require(joint.type == JointType::fixed || joint.type == JointType::floating ||
                    std::abs(length(joint.axis) - 1) <= kRigidError,
                "the axis of joint '" + joint.name + "' is not of unit length");
        require(joint.limits.lower <= joint.limits.upper &&
                    joint.limits.lower < std::numeric_limits<double>::infinity() &&
                    joint.limits.upper > -std::numeric_limits<double>::infinity(),
                "the limits of joint '" + joint.name + "' leave no value");
        require(!joint.mimic ||
                    (joint.mimic->joint < robot.joints.size() &&
                     !robot.joints[joint.mimic->joint].mimic &&
                     variables_of(robot.joints[joint.mimic->joint].type) == 1 &&
                     variables_of(joint.type) == 1 && std::isfinite(joint.mimic->multiplier) &&
                     std::isfinite(joint.mimic->offset)),
                "joint '" + joint.name + "' cannot follow the joint that it names");
    }
    for (const RobotLink& link : robot.links)
        for (const RobotShape& shape : link.shapes) {
            const std::string what = "the transform of a shape of link '" + link.name + "'";
            require_finite(shape.link_from_shape, what.c_str());
        }
    for (std::size_t i = 0; i < placed.size(); ++i)
        require(placed[i], "no joint moves link '" + robot.links[i].name + "'");
}

/// The nearest link above a link that has shapes; none if there is none.
std::uint32_t shaped_link_above(const RobotData& data, std::uint32_t link) {
    while (true) {
        const std::uint32_t joint = data.joint_above[link];
        if (joint == kNoJoint)
            return kNoJoint;
        link = data.description.joints[joint].parent;
        if (!data.description.links[link].shapes.empty())
            return link;
    }
}

std::set<std::pair<std::uint32_t, std::uint32_t>> left_out(const RobotData& data,
                                                           bool allow_adjacent) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> result;
    for (const AllowedPair& pair : data.allowed) {
        require(pair.a < data.description.links.size() && pair.b < data.description.links.size(),
                "an allowed pair names a link that is out of range");
        result.insert(std::minmax(pair.a, pair.b));
    }
    for (std::uint32_t link = 0; allow_adjacent && link < data.description.links.size(); ++link)
        if (const std::uint32_t above = shaped_link_above(data, link); above != kNoJoint)
            result.insert(std::minmax(link, above));
    return result;
}

} // namespace

std::vector<RobotBody> make_body(std::uint32_t owner, const Model& model,
                                 const Transform& owner_from_model) {
    const MeshReport report = inspect(model.mesh());
    if (report.triangles == 0)
        return {};
    const Vec3 middle = 0.5 * (report.bounds.lower + report.bounds.upper);
    const Vec3 centre = apply(owner_from_model, middle);
    double radius = 0;
    for (const auto& triangle : model.mesh().triangles)
        for (const std::uint32_t corner : triangle)
            radius = std::max(
                radius, length(apply(owner_from_model, model.mesh().positions[corner]) - centre));
    const double rounding = kRadiusShare * (radius + max_abs(centre));
    std::vector<Vec3> points;
    for (const auto& triangle : model.mesh().triangles)
        for (const std::uint32_t corner : triangle)
            points.push_back(model.mesh().positions[corner]);
    std::vector<Vec3> vertices;
    for (const std::uint32_t triangle :
         component_representatives(model.mesh(), make_topology(model.mesh())))
        vertices.push_back(model.mesh().positions[model.mesh().triangles[triangle][0]]);
    return {{owner, model, owner_from_model, centre, radius + rounding, report.closed,
             report.bounds, std::move(vertices), Convex(points)}};
}

RobotData::RobotData(RobotDescription robot, const RobotOptions& options)
    : description(std::move(robot)), allowed(options.allowed) {
    require_tree(description);
    joints = number_variables(description);
    joint_above.assign(description.links.size(), kNoJoint);
    for (std::uint32_t i = 0; i < description.joints.size(); ++i)
        joint_above[description.joints[i].child] = i;
    std::vector<std::vector<std::uint32_t>> bodies_of(description.links.size());
    for (std::uint32_t link = 0; link < description.links.size(); ++link)
        for (const RobotShape& shape : description.links[link].shapes) {
            try {
                for (RobotBody& body : make_body(link, Model(shape.mesh), shape.link_from_shape)) {
                    bodies_of[link].push_back(static_cast<std::uint32_t>(bodies.size()));
                    bodies.push_back(std::move(body));
                }
            } catch (const Error& error) {
                throw Error(error.code(),
                            "link '" + description.links[link].name + "': " + error.what());
            }
        }
    const auto out = left_out(*this, options.allow_adjacent);
    for (std::uint32_t a = 0; a < bodies_of.size(); ++a)
        for (std::uint32_t b = a + 1; b < bodies_of.size(); ++b) {
            if (bodies_of[a].empty() || bodies_of[b].empty() || out.contains({a, b}))
                continue;
            pairs.emplace_back(a, b);
            for (const std::uint32_t of_a : bodies_of[a])
                for (const std::uint32_t of_b : bodies_of[b])
                    tests.push_back({of_a, of_b});
        }
}

void RobotData::require_valid(std::span<const double> configuration) const {
    if (configuration.size() != joints.variables.size())
        throw Error(ErrorCode::bad_argument,
                    "a configuration has " + std::to_string(configuration.size()) +
                        " values where the robot has " + std::to_string(joints.variables.size()) +
                        " variables");
    for (std::size_t i = 0; i < configuration.size(); ++i)
        if (!(std::abs(configuration[i]) <= kLargestValue))
            throw Error(ErrorCode::bad_argument, "the value of '" + joints.variables[i].name +
                                                     "' is not finite or is beyond 1e9");
    for (std::size_t i = 0; i < description.joints.size(); ++i)
        if (!(mimic_size(description.joints[i], joints.first[i], configuration) <= kLargestValue))
            throw Error(ErrorCode::bad_argument,
                        "the value of '" + description.joints[i].name +
                            "', which follows another joint, is beyond 1e9");
}

ObstacleData::ObstacleData(std::vector<RobotObstacle> obstacles) : list(std::move(obstacles)) {
    std::vector<std::vector<RobotBody>> made(list.size());
    parallel_for(list.size(), 1, [&](std::size_t i) {
        const std::string what = "the transform of obstacle '" + list[i].name + "'";
        require_finite(list[i].world_from_model, what.c_str());
        made[i] = make_body(static_cast<std::uint32_t>(i), list[i].model, list[i].world_from_model);
    });
    for (std::vector<RobotBody>& each : made)
        std::ranges::move(each, std::back_inserter(bodies));
}

RobotObstacles::RobotObstacles(std::vector<RobotObstacle> obstacles)
    : data_(std::make_shared<const ObstacleData>(std::move(obstacles))) {}

const std::vector<RobotObstacle>& RobotObstacles::list() const noexcept {
    static const std::vector<RobotObstacle> none;
    return data_ ? data_->list : none;
}

Robot::Robot(RobotDescription description, const RobotOptions& options)
    : data_(std::make_shared<const RobotData>(std::move(description), options)) {}

const RobotDescription& Robot::description() const noexcept {
    return data_->description;
}

const std::vector<RobotVariable>& Robot::variables() const noexcept {
    return data_->joints.variables;
}

std::vector<double> Robot::default_configuration() const {
    std::vector<double> values;
    for (const RobotVariable& variable : variables())
        values.push_back(std::clamp(0.0, variable.limits.lower, variable.limits.upper));
    return values;
}

const std::vector<std::pair<std::uint32_t, std::uint32_t>>& Robot::pairs() const noexcept {
    return data_->pairs;
}

std::vector<Transform> Robot::link_transforms(std::span<const double> configuration) const {
    data_->require_valid(configuration);
    std::vector<Transform> links;
    forward_kinematics(data_->description, data_->joints, configuration, links);
    return links;
}

std::vector<std::uint32_t> Robot::beyond_limits(std::span<const double> configuration) const {
    constexpr double kTolerance = 1e-9; // radians or metres: rounding of decimal input
    data_->require_valid(configuration);
    std::vector<std::uint32_t> beyond;
    for (std::uint32_t i = 0; i < configuration.size(); ++i)
        if (const JointLimits& limits = variables()[i].limits;
            configuration[i] < limits.lower - kTolerance ||
            configuration[i] > limits.upper + kTolerance)
            beyond.push_back(i);
    return beyond;
}

} // namespace abut
