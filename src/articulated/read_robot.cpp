#include <abut/error.h>
#include <abut/robot_description.h>

#include "articulated/joint_order.h"
#include "articulated/package_path.h"
#include "articulated/shape_meshes.h"
#include "articulated/xml_file.h"
#include "io/file/fault.h"
#include "math/transform.h"

#include <cmath>
#include <map>
#include <utility>

namespace abut {

namespace {

/// A frame given by <origin xyz="…" rpy="…">: rotations about the fixed axes x, y, z in turn.
Transform origin_transform(const XmlFile& file, pugi::xml_node owner) {
    const pugi::xml_node origin = owner.child("origin");
    const Vec3 p = file.vector(origin, "xyz", {});
    const Vec3 rpy = file.vector(origin, "rpy", {});
    const double cr = std::cos(rpy.x);
    const double sr = std::sin(rpy.x);
    const double cp = std::cos(rpy.y);
    const double sp = std::sin(rpy.y);
    const double cy = std::cos(rpy.z);
    const double sy = std::sin(rpy.z);
    return Transform({cy * cp, sy * cp, -sp,                                   //
                      cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr, //
                      cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr, //
                      p.x, p.y, p.z});
}

double positive_size(const XmlFile& file, pugi::xml_node node, const char* attribute) {
    const double value = file.number(node, attribute);
    if (!(value > 0))
        file.fail(node,
                  std::string("the ") + attribute + " of <" + node.name() + "> is not positive");
    return value;
}

class UrdfReader {
public:
    UrdfReader(const std::string& path, const RobotReadOptions& options)
        : file_(path), options_(options) {
        robot_.file = path;
    }

    RobotDescription read() {
        const pugi::xml_node root = file_.root();
        if (root.name() != std::string("robot"))
            file_.fail(root, "the root element is <" + std::string(root.name()) + ">, not <robot>");
        robot_.name = root.attribute("name").as_string();
        for (const pugi::xml_node link : root.children("link"))
            read_link(link);
        if (robot_.links.empty())
            file_.fail(root, "the robot has no link");
        for (const pugi::xml_node joint : root.children("joint"))
            read_joint(joint);
        read_mimics();
        order_joints(root);
        return std::move(robot_);
    }

private:
    void read_link(pugi::xml_node node) {
        RobotLink link{file_.text(node, "name"), {}};
        if (!link_of_.try_emplace(link.name, robot_.links.size()).second)
            file_.fail(node, "the link '" + link.name + "' is defined twice");
        for (const pugi::xml_node shape : node.children(options_.visual ? "visual" : "collision"))
            read_shape(shape, link);
        robot_.links.push_back(std::move(link));
    }

    void read_shape(pugi::xml_node node, RobotLink& link) {
        const pugi::xml_node geometry = node.child("geometry");
        const pugi::xml_node form = geometry.find_child(
            [](pugi::xml_node child) { return child.type() == pugi::node_element; });
        const std::string kind = form.name();
        RobotShape shape{kind, {}, origin_transform(file_, node), 0};
        if (kind == "mesh") {
            shape.name = file_.text(form, "filename");
            shape.mesh = mesh_of(form, shape.name, link.name);
        } else if (kind == "box") {
            const std::vector<double> size = file_.numbers(form, "size", 3);
            if (!(size[0] > 0 && size[1] > 0 && size[2] > 0))
                file_.fail(form, "a size of the box of link '" + link.name + "' is not positive");
            shape.mesh = box_mesh({size[0], size[1], size[2]});
        } else if (kind == "cylinder") {
            set_mesh(shape, cylinder_mesh(positive_size(file_, form, "radius"),
                                          positive_size(file_, form, "length")));
        } else if (kind == "sphere") {
            set_mesh(shape, sphere_mesh(positive_size(file_, form, "radius")));
        } else {
            file_.fail(geometry ? geometry : node,
                       "the shape of link '" + link.name + "' is " +
                           (kind.empty() ? "missing" : "<" + kind + ">, which is unknown"));
        }
        link.shapes.push_back(std::move(shape));
    }

    static void set_mesh(RobotShape& shape, EnclosingMesh enclosing) {
        shape.mesh = std::move(enclosing.mesh);
        shape.excess = enclosing.excess;
    }

    Mesh mesh_of(pugi::xml_node form, const std::string& name, const std::string& link) {
        const Vec3 scale = file_.vector(form, "scale", {1, 1, 1});
        if (scale.x == 0 || scale.y == 0 || scale.z == 0)
            file_.fail(form, "the scale of the mesh of link '" + link + "' is 0");
        try {
            Mesh mesh = loaded(name);
            scale_mesh(mesh, scale);
            return mesh;
        } catch (const Fault& fault) {
            throw Error(fault.code(), file_.path(), "link '" + link + "': " + fault.what());
        }
    }

    const Mesh& loaded(const std::string& name) {
        const auto [place, is_new] = meshes_.try_emplace(name);
        if (is_new) {
            const PackageFile found = find_package_file(
                name, file_.path(), options_.package_folders, options_.read.allow_outside_files);
            place->second = read_mesh(found.path, options_.read);
        }
        return place->second;
    }

    std::uint32_t link_named(pugi::xml_node joint, const char* element, const std::string& name) {
        const pugi::xml_node node = joint.child(element);
        if (!node)
            file_.fail(joint, "the joint '" + name + "' has no <" + element + ">");
        const std::string link = file_.text(node, "link");
        const auto found = link_of_.find(link);
        if (found == link_of_.end())
            file_.fail(node, "the " + std::string(element) + " link '" + link + "' of joint '" +
                                 name + "' is not defined");
        return static_cast<std::uint32_t>(found->second);
    }

    void read_joint(pugi::xml_node node) {
        RobotJoint joint;
        joint.name = file_.text(node, "name");
        if (!joint_of_.try_emplace(joint.name, robot_.joints.size()).second)
            file_.fail(node, "the joint '" + joint.name + "' is defined twice");
        const std::string type = file_.text(node, "type");
        bool is_known = false;
        for (const JointType each : kJointTypes)
            if (type == to_string(each))
                joint.type = each, is_known = true;
        if (!is_known)
            file_.fail(node, "the type '" + type + "' of joint '" + joint.name + "' is unknown");
        joint.parent = link_named(node, "parent", joint.name);
        joint.child = link_named(node, "child", joint.name);
        joint.parent_from_joint = origin_transform(file_, node);
        read_axis(node, joint);
        read_limits(node, joint);
        nodes_.push_back(node);
        robot_.joints.push_back(std::move(joint));
    }

    void read_axis(pugi::xml_node node, RobotJoint& joint) {
        if (joint.type == JointType::fixed || joint.type == JointType::floating)
            return;
        const Vec3 axis = file_.vector(node.child("axis"), "xyz", {1, 0, 0});
        const double size = length(axis);
        if (!(size > 0) || !std::isfinite(size))
            file_.fail(node.child("axis"),
                       "the axis of joint '" + joint.name + "' has no direction");
        joint.axis = (1 / size) * axis;
    }

    void read_limits(pugi::xml_node node, RobotJoint& joint) {
        if (joint.type != JointType::revolute && joint.type != JointType::prismatic)
            return;
        const pugi::xml_node limit = node.child("limit");
        if (!limit)
            file_.fail(node, "the " + std::string(to_string(joint.type)) + " joint '" + joint.name +
                                 "' needs a <limit>");
        joint.limits = {file_.number(limit, "lower", 0), file_.number(limit, "upper", 0)};
        if (joint.limits.lower > joint.limits.upper)
            file_.fail(limit,
                       "the lower limit of joint '" + joint.name + "' is above the upper one");
    }

    void read_mimics() {
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const pugi::xml_node mimic = nodes_[i].child("mimic");
            RobotJoint& joint = robot_.joints[i];
            if (!mimic)
                continue;
            const std::string name = file_.text(mimic, "joint");
            const auto source = joint_of_.find(name);
            if (source == joint_of_.end())
                file_.fail(mimic, "the joint '" + name + "' that joint '" + joint.name +
                                      "' follows is not defined");
            const JointType source_type = robot_.joints[source->second].type;
            if (joint.type == JointType::fixed) {
                robot_.warnings.push_back("the fixed joint '" + joint.name +
                                          "' cannot follow joint '" + name + "'");
                continue;
            }
            if (variables_of(joint.type) != 1 || variables_of(source_type) != 1)
                file_.fail(mimic, "joint '" + joint.name + "' cannot follow joint '" + name +
                                      "': both need one variable");
            joint.mimic =
                JointMimic{static_cast<std::uint32_t>(source->second),
                           file_.number(mimic, "multiplier", 1), file_.number(mimic, "offset", 0)};
        }
        resolve_mimics();
    }

    /// Makes joints that follow a follower follow its source.
    void resolve_mimics() {
        for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
            RobotJoint& joint = robot_.joints[i];
            for (std::size_t steps = 0; joint.mimic; ++steps) {
                const RobotJoint& source = robot_.joints[joint.mimic->joint];
                if (joint.mimic->joint == i || steps > robot_.joints.size())
                    file_.fail(nodes_[i].child("mimic"),
                               "joint '" + joint.name + "' follows itself");
                if (!source.mimic)
                    break;
                joint.mimic = JointMimic{
                    source.mimic->joint, joint.mimic->multiplier * source.mimic->multiplier,
                    joint.mimic->multiplier * source.mimic->offset + joint.mimic->offset};
            }
        }
    }

    void order_joints(pugi::xml_node root) {
        try {
            sort_joints(robot_);
        } catch (const JointFault& fault) {
            file_.fail(fault.joint ? nodes_[*fault.joint] : root, fault.what());
        }
    }

    XmlFile file_;
    const RobotReadOptions& options_;
    RobotDescription robot_;
    std::map<std::string, std::size_t> link_of_, joint_of_;
    std::vector<pugi::xml_node> nodes_; ///< of the joints, in the order of the file
    std::map<std::string, Mesh> meshes_;
};

} // namespace

const char* to_string(JointType type) {
    constexpr std::array kNames{"fixed",     "revolute", "continuous",
                                "prismatic", "planar",   "floating"};
    return kNames.at(static_cast<std::size_t>(type));
}

std::size_t variables_of(JointType type) {
    switch (type) {
    case JointType::fixed:
        return 0;
    case JointType::planar:
        return 3;
    case JointType::floating:
        return 6;
    default:
        return 1;
    }
}

RobotDescription read_robot(const std::string& path, const RobotReadOptions& options) {
    return UrdfReader(path, options).read();
}

} // namespace abut
