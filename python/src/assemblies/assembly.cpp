#include <abut/assembly.h>

#include "models/scenes.h"
#include "module.h"
#include "queries/queries.h"
#include "support/arrays.h"
#include "support/enums.h"
#include "support/records.h"
#include "support/work.h"

namespace abut::python {

namespace {

void bind_joint(py::module_& module) {
    bind_enum<AssemblyJointType>(module, "AssemblyJointType",
                                 {"fixed", "revolute", "prismatic", "free"},
                                 "How a part moves on the part that it hangs on.");
    PlainBinder<JointKeys>(module, "JointKeys",
                           "JointKeys(times=(), values=(), poses=())\n\nThe value of a joint over "
                           "time; between two keys it changes at a constant rate.")
        .field("times", &JointKeys::times, "list of seconds, ascending")
        .field("values", &JointKeys::values, "list of radians or metres, one for each time")
        .field("poses", &JointKeys::poses, "list of Pose, one for each time, of a free joint")
        .done()
        .def(py::init([](const std::vector<double>& times, const std::vector<double>& values,
                         const std::vector<Pose>& poses) {
                 return JointKeys{times, values, poses};
             }),
             py::arg("times") = std::vector<double>(), py::arg("values") = std::vector<double>(),
             py::arg("poses") = std::vector<Pose>());
    PlainBinder<JointFollow>(module, "JointFollow",
                             "JointFollow(part, ratio=1, offset=0)\n\nA joint that follows that of "
                             "another part: ratio * value + offset.")
        .field("part", &JointFollow::part, "index of the part that is followed")
        .field("ratio", &JointFollow::ratio, "")
        .field("offset", &JointFollow::offset, "radians or metres")
        .done()
        .def(py::init([](std::uint32_t part, double ratio, double offset) {
                 return JointFollow{part, ratio, offset};
             }),
             py::arg("part"), py::arg("ratio") = 1, py::arg("offset") = 0);
    PlainBinder<AssemblyJoint>(
        module, "AssemblyJoint",
        "AssemblyJoint(type='fixed', *, origin=(0, 0, 0), axis=(0, 0, 1), limits=(-inf, inf), "
        "keys=None, follow=None)\n\nHow a part moves on the part that it hangs on. Points are "
        "those at rest.")
        .field("type", &AssemblyJoint::type, "AssemblyJointType")
        .field("origin", &AssemblyJoint::origin, "a point of the axis")
        .field("axis", &AssemblyJoint::axis, "")
        .field("limits", &AssemblyJoint::limits, "JointLimits")
        .field("keys", &AssemblyJoint::keys, "JointKeys")
        .field("follow", &AssemblyJoint::follow, "JointFollow, or None")
        .done()
        .def(py::init([](const py::object& type, const py::object& origin, const py::object& axis,
                         const std::pair<double, double>& limits,
                         const std::optional<JointKeys>& keys,
                         const std::optional<JointFollow>& follow) {
                 return AssemblyJoint{to_enum<AssemblyJointType>(type),
                                      to_vec3(origin, "origin"),
                                      to_vec3(axis, "axis"),
                                      {limits.first, limits.second},
                                      keys.value_or(JointKeys{}),
                                      follow};
             }),
             py::arg("type") = "fixed", py::kw_only(), py::arg("origin") = py::make_tuple(0, 0, 0),
             py::arg("axis") = py::make_tuple(0, 0, 1),
             py::arg("limits") = std::pair(-std::numeric_limits<double>::infinity(),
                                           std::numeric_limits<double>::infinity()),
             py::arg("keys") = std::nullopt, py::arg("follow") = std::nullopt);
}

void bind_parts(py::module_& module) {
    PlainBinder<AssemblyPart>(module, "AssemblyPart",
                              "AssemblyPart(name, model, *, pose=None, on=None, joint=None)\n\n"
                              "A part of an assembly.")
        .field("name", &AssemblyPart::name, "")
        .field("file", &AssemblyPart::file, "of its model; may be empty")
        .field("model", &AssemblyPart::model, "Model")
        .field("place", &AssemblyPart::place, "matrix of shape (4, 4): its place at rest")
        .field("on", &AssemblyPart::on, "index of the part that it hangs on; None: the world")
        .field("joint", &AssemblyPart::joint, "AssemblyJoint")
        .done()
        .def(py::init([](const std::string& name, const Model& model, const py::object& pose,
                         std::optional<std::uint32_t> on,
                         const std::optional<AssemblyJoint>& joint) {
                 return AssemblyPart{name,  {},
                                     model, to_transform(pose, "pose"),
                                     on,    joint.value_or(AssemblyJoint{})};
             }),
             py::arg("name"), py::arg("model"), py::kw_only(), py::arg("pose") = py::none(),
             py::arg("on") = std::nullopt, py::arg("joint") = std::nullopt);
    PlainBinder<AssemblyLoop>(module, "AssemblyLoop",
                              "AssemblyLoop(coupler, closer, pin)\n\nA closed chain: a rod and a "
                              "piston or a rocker that a pin joins.")
        .field("coupler", &AssemblyLoop::coupler, "index of a part: the rod")
        .field("closer", &AssemblyLoop::closer, "index of a part: the piston or the rocker")
        .field("pin", &AssemblyLoop::pin, "a point of the pin's axis at rest")
        .done()
        .def(py::init([](std::uint32_t coupler, std::uint32_t closer, const py::object& pin) {
                 return AssemblyLoop{coupler, closer, to_vec3(pin, "pin")};
             }),
             py::arg("coupler"), py::arg("closer"), py::arg("pin"));
    PlainBinder<Assembly>(module, "Assembly",
                          "Assembly(parts, *, loops=(), ignored=())\n\nParts that move on each "
                          "other, as read_assembly returns them.")
        .field("file", &Assembly::file, "path as given")
        .field("parts", &Assembly::parts, "list of AssemblyPart")
        .field("loops", &Assembly::loops, "list of AssemblyLoop")
        .field("ignored", &Assembly::ignored, "list of pairs of parts that are not tested")
        .field("up", &Assembly::up, "UpAxis")
        .done()
        .def(py::init([](const std::vector<AssemblyPart>& parts,
                         const std::vector<AssemblyLoop>& loops,
                         const std::vector<std::pair<std::uint32_t, std::uint32_t>>& ignored) {
                 return Assembly{{}, parts, loops, ignored};
             }),
             py::arg("parts"), py::kw_only(), py::arg("loops") = std::vector<AssemblyLoop>(),
             py::arg("ignored") = std::vector<std::pair<std::uint32_t, std::uint32_t>>());
}

void bind_motion_results(py::module_& module) {
    bind_enum<MotionClashKind>(module, "MotionClashKind", {"contact", "clearance"},
                               "Whether a pair meets, or only comes near.");
    PlainBinder<MotionInterval>(module, "MotionInterval",
                                "A span of time in which a pair is in contact, or near.")
        .field("start", &MotionInterval::start, "never later than the first contact")
        .field("end", &MotionInterval::end, "never earlier than the last contact")
        .field("seen", &MotionInterval::seen, "a time of contact; inf: none was seen")
        .done();
    PlainBinder<MotionSample>(module, "MotionSample", "The gap of a pair at a time.")
        .field("time", &MotionSample::time, "seconds")
        .field("gap", &MotionSample::gap, "metres")
        .done();
    PlainBinder<MotionClash>(module, "MotionClash", "What happens between two parts over time.")
        .field("a", &MotionClash::a, "index of a part")
        .field("b", &MotionClash::b, "index of a part, above a")
        .field("kind", &MotionClash::kind, "MotionClashKind")
        .field("contacts", &MotionClash::contacts, "list of MotionInterval")
        .field("approaches", &MotionClash::approaches, "list of MotionInterval")
        .field("gap", &MotionClash::gap, "metres: the least that was measured")
        .field("gap_at_least", &MotionClash::gap_at_least, "a proven lower bound of it")
        .field("gap_time", &MotionClash::gap_time, "seconds")
        .field("point_a", &MotionClash::point_a, "the nearest point then")
        .field("point_b", &MotionClash::point_b, "the nearest point then")
        .field("depth", &MotionClash::depth, "metres: the largest that was measured")
        .field("depth_at_most", &MotionClash::depth_at_most, "an upper bound of it; may be inf")
        .field("depth_time", &MotionClash::depth_time, "seconds")
        .field("depth_point", &MotionClash::depth_point, "on b then")
        .field("samples", &MotionClash::samples, "list of MotionSample")
        .field("status", &MotionClash::status, "Status; bound_only: contact was not decided")
        .field("steps", &MotionClash::steps, "measurements")
        .done();
    PlainBinder<MotionReport>(module, "MotionReport", "The clashes of an assembly over time.")
        .field("start", &MotionReport::start, "seconds")
        .field("end", &MotionReport::end, "seconds")
        .field("clearance", &MotionReport::clearance, "as asked, metres")
        .field("tolerance", &MotionReport::tolerance, "as asked, metres")
        .field("clashes", &MotionReport::clashes, "list of MotionClash, contacts first")
        .field("pairs", &MotionReport::pairs, "all pairs of parts")
        .field("still", &MotionReport::still, "of them: without relative motion")
        .field("joined", &MotionReport::joined, "of them: joined by a joint or a loop")
        .field("ignored", &MotionReport::ignored, "of them: left out on request")
        .field("near", &MotionReport::near, "of them: measured")
        .field("slices", &MotionReport::slices, "of time")
        .field("steps", &MotionReport::steps, "measurements")
        .done();
}

void bind_motion_functions(py::module_& module) {
    module.def(
        "read_assembly",
        [](const py::object& path, bool outside, const py::object& report) {
            ReadOptions options{.allow_outside_files = outside};
            const std::string file = to_path(path);
            Work work(report);
            return work.run([&](const Progress& progress) {
                options.progress = progress;
                return read_assembly(file, options);
            });
        },
        py::arg("path"), py::kw_only(), py::arg("allow_outside_files") = false,
        py::arg("progress") = py::none(),
        "Reads an assembly in motion from a TOML or JSON file.\n\n"
        "allow_outside_files  whether models outside of the file's folder may be read\n"
        "progress             function of (stage, fraction)\n\n"
        "Returns Assembly. Raises Error, naming the file and the element.");
    module.def(
        "part_transforms",
        [](const Assembly& assembly, double time) { return part_transforms(assembly, time); },
        py::arg("assembly"), py::arg("time"),
        "The place of each part at a time: list of matrices of shape (4, 4).");
    module.def("time_range", &time_range, py::arg("assembly"),
               "The first and the last time of all keys.");
    module.def(
        "find_motion_clashes",
        [](const Assembly& assembly, double clearance, double tolerance, double step, bool joined,
           std::uint64_t max_steps, const py::object& report) {
            Work work(report);
            return work.run([&](const Progress& progress) {
                return find_motion_clashes(
                    assembly, {clearance, tolerance, step, joined, max_steps, progress});
            });
        },
        py::arg("assembly"), py::kw_only(), py::arg("clearance") = 0.0, py::arg("tolerance") = 1e-5,
        py::arg("step") = 0.0, py::arg("joined") = false, py::arg("max_steps") = 20'000,
        py::arg("progress") = py::none(),
        "Finds every clash between the parts of an assembly while it moves.\n\n"
        "clearance  also finds pairs that come at most this near\n"
        "tolerance  parts at most this far apart count as in contact\n"
        "step       seconds: shorter contacts and separations may be joined; 0: a thousandth of "
        "the duration\n"
        "joined     whether pairs that a joint or a loop connects are tested, too\n"
        "max_steps  measurements of a pair, before they become coarse\n"
        "progress   function of (stage, fraction)\n\n"
        "Returns MotionReport. No contact is missed between samples.");
}

void bind_motion_writers(py::module_& module) {
    module.def(
        "write_motion_csv",
        [](const MotionReport& report, const Assembly& assembly, const py::object& path) {
            write_motion_csv(report, assembly, to_path(path));
        },
        py::arg("report"), py::arg("assembly"), py::arg("path"),
        "Writes a row for each contact and each approach.");
    module.def(
        "write_motion_html",
        [](const MotionReport& report, const Assembly& assembly, const py::object& path) {
            write_motion_html(report, assembly, to_path(path));
        },
        py::arg("report"), py::arg("assembly"), py::arg("path"),
        "Writes one HTML page with a chart over time and tables.");
}

} // namespace

void bind_assembly(py::module_& module) {
    bind_joint(module);
    bind_parts(module);
    bind_motion_results(module);
    bind_motion_functions(module);
    bind_motion_writers(module);
}

} // namespace abut::python
