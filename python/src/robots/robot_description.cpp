#include <abut/robot_description.h>

#include "models/scenes.h"
#include "module.h"
#include "support/arrays.h"
#include "support/enums.h"
#include "support/meshes.h"
#include "support/records.h"
#include "support/work.h"

namespace abut::python {

namespace {

void bind_joints(py::module_& module) {
    bind_enum<JointType>(module, "JointType",
                         {"fixed", "revolute", "continuous", "prismatic", "planar", "floating"},
                         "How a joint moves its child link.");
    PlainBinder<JointLimits>(module, "JointLimits", "Bounds of a joint's value.")
        .field("lower", &JointLimits::lower, "radians or metres; -inf: none")
        .field("upper", &JointLimits::upper, "radians or metres; inf: none")
        .done();
    PlainBinder<JointMimic>(module, "JointMimic",
                            "A joint that follows another: multiplier * value + offset.")
        .field("joint", &JointMimic::joint, "index of the joint that is followed")
        .field("multiplier", &JointMimic::multiplier, "")
        .field("offset", &JointMimic::offset, "radians or metres")
        .done();
    PlainBinder<RobotJoint>(module, "RobotJoint", "A joint between two links.")
        .field("name", &RobotJoint::name, "")
        .field("type", &RobotJoint::type, "JointType")
        .field("parent", &RobotJoint::parent, "index of a link")
        .field("child", &RobotJoint::child, "index of a link")
        .field("parent_from_joint", &RobotJoint::parent_from_joint,
               "matrix of shape (4, 4): the child's frame where all values are 0")
        .field("axis", &RobotJoint::axis, "unit vector in the joint's frame")
        .field("limits", &RobotJoint::limits, "JointLimits")
        .field("mimic", &RobotJoint::mimic, "JointMimic, or None")
        .done();
}

void bind_links(py::module_& module) {
    PlainBinder<RobotShape>(module, "RobotShape", "A collision shape of a link.")
        .field("name", &RobotShape::name, "path of its mesh, or 'box', 'cylinder', 'sphere'")
        .field("mesh", &RobotShape::mesh, "Mesh in the shape's frame, in metres")
        .field("link_from_shape", &RobotShape::link_from_shape, "matrix of shape (4, 4)")
        .field("excess", &RobotShape::excess,
               "metres: how far the mesh reaches out of the shape, at most")
        .done();
    PlainBinder<RobotLink>(module, "RobotLink", "A link of a robot.")
        .field("name", &RobotLink::name, "")
        .field("shapes", &RobotLink::shapes, "list of RobotShape")
        .done();
    PlainBinder<RobotDescription>(module, "RobotDescription",
                                  "A tree of links, as read_robot returns it.")
        .field("name", &RobotDescription::name, "")
        .field("file", &RobotDescription::file, "path as given")
        .field("links", &RobotDescription::links, "list of RobotLink")
        .field("joints", &RobotDescription::joints, "list of RobotJoint, parents first")
        .field("root", &RobotDescription::root, "index of the link that no joint moves")
        .field("warnings", &RobotDescription::warnings, "list of str")
        .done();
}

void bind_semantics(py::module_& module) {
    bind_enum<AllowReason>(module, "AllowReason",
                           {"adjacent", "at_rest", "always", "never", "user"},
                           "The reason why a pair of links is not tested.");
    PlainBinder<AllowedPair>(module, "AllowedPair",
                             "AllowedPair(a, b, reason='user')\n\nA pair of links that may meet.")
        .field("a", &AllowedPair::a, "index of a link")
        .field("b", &AllowedPair::b, "index of a link")
        .field("reason", &AllowedPair::reason, "AllowReason")
        .done()
        .def(py::init([](std::uint32_t a, std::uint32_t b, AllowReason reason) {
                 return AllowedPair{a, b, reason};
             }),
             py::arg("a"), py::arg("b"), py::arg("reason") = "user");
    PlainBinder<NamedState>(module, "NamedState", "Values of some joints under a name.")
        .field("name", &NamedState::name, "")
        .field("group", &NamedState::group, "")
        .field("joints", &NamedState::joints, "list of (name, values)")
        .done();
    PlainBinder<RobotSemantics>(module, "RobotSemantics", "The content of an SRDF file.")
        .field("allowed", &RobotSemantics::allowed, "list of AllowedPair")
        .field("states", &RobotSemantics::states, "list of NamedState")
        .field("warnings", &RobotSemantics::warnings, "list of str")
        .done();
}

} // namespace

void bind_robot_description(py::module_& module) {
    bind_joints(module);
    bind_links(module);
    bind_semantics(module);
    module.def(
        "read_robot",
        [](const py::object& path, const std::vector<std::string>& packages, bool visual,
           bool outside, const py::object& report) {
            RobotReadOptions options{.package_folders = packages, .visual = visual};
            options.read.allow_outside_files = outside;
            const std::string file = to_path(path);
            Work work(report);
            return work.run([&](const Progress& progress) {
                options.read.progress = progress;
                return read_robot(file, options);
            });
        },
        py::arg("path"), py::kw_only(), py::arg("package_folders") = std::vector<std::string>(),
        py::arg("visual") = false, py::arg("allow_outside_files") = false,
        py::arg("progress") = py::none(),
        "Reads a URDF file with its meshes.\n\n"
        "package_folders      folders that hold the packages of package://NAME/…\n"
        "visual               whether to read the visual shapes in place of the collision shapes\n"
        "allow_outside_files  whether meshes outside of their package may be read\n"
        "progress             function of (stage, fraction)\n\n"
        "Returns RobotDescription. Raises Error, naming the file and the line.");
    module.def(
        "read_srdf",
        [](const py::object& path, const RobotDescription& robot) {
            return read_srdf(to_path(path), robot);
        },
        py::arg("path"), py::arg("robot"),
        "Reads the allowed pairs and the named states of an SRDF file. Returns RobotSemantics.");
    module.def(
        "write_srdf",
        [](const RobotDescription& robot, const std::vector<AllowedPair>& allowed,
           const py::object& path, const py::object& base) {
            write_srdf(robot, allowed, to_path(path), base.is_none() ? "" : to_path(base));
        },
        py::arg("robot"), py::arg("allowed"), py::arg("path"), py::arg("base") = py::none(),
        "Writes allowed pairs as an SRDF file; all else is taken from `base`, if it is given.");
    module.def("variables_of", &variables_of, py::arg("type"),
               "The number of values that place a joint of this type.");
}

} // namespace abut::python
