#include <abut/batch.h>
#include <abut/motion.h>

#include "module.h"
#include "queries/queries.h"

namespace abut::python {

namespace {

py::object make_motions(const py::object& start, const py::object& end,
                        const std::function<Motion(const Pose&, const Pose&)>& make) {
    const auto is_many = [](const py::object& poses) {
        return !poses.is_none() && to_poses(poses, "pose").many;
    };
    const bool many_starts = is_many(start), many_ends = is_many(end);
    if (!many_starts && !many_ends)
        return py::cast(make(to_pose(start, "start"), to_pose(end, "end")));
    const auto starts =
        many_starts ? to_pose_list(start, "start") : std::vector<Pose>{to_pose(start, "start")};
    const auto ends = many_ends ? to_pose_list(end, "end") : std::vector<Pose>{to_pose(end, "end")};
    BatchSize size;
    size.add(many_starts, starts.size(), "start");
    size.add(many_ends, ends.size(), "end");
    py::list list;
    for (std::size_t i = 0; i < size.size(); ++i)
        list.append(make(starts[many_starts ? i : 0], ends[many_ends ? i : 0]));
    return list;
}

struct MotionArgument {
    bool many = false;
    std::vector<Motion> list;
};

MotionArgument to_motions(py::handle object, const char* name) {
    MotionArgument result;
    if (const auto* motion = peek<Motion>(object)) {
        result.list = {*motion};
        return result;
    }
    if (PyList_Check(object.ptr()) || PyTuple_Check(object.ptr())) {
        const auto sequence = py::reinterpret_borrow<py::sequence>(object);
        if (py::len(sequence) > 0 && peek<Motion>(py::object(sequence[0]))) {
            result.many = true;
            for (const py::handle item : sequence)
                result.list.push_back(get<Motion>(item, name));
            return result;
        }
    }
    result.list = {Motion::fixed(to_pose(object, name))};
    return result;
}

py::object run_time_of_impact(const Arguments& arguments) {
    const Model& a = get<Model>(arguments[0], "a");
    const Model& b = get<Model>(arguments[2], "b");
    const MotionArgument motion_a = to_motions(arguments[1], "motion_a");
    const MotionArgument motion_b = to_motions(arguments[3], "motion_b");
    ImpactOptions options;
    arguments.take(4, "absolute_error", options.absolute_error);
    arguments.take(5, "max_steps", options.max_steps);
    Work work(arguments[6]);
    BatchSize size;
    size.add(motion_a.many, motion_a.list.size(), "motion_a");
    size.add(motion_b.many, motion_b.list.size(), "motion_b");
    if (!size.many())
        return py::cast(work.run([&](const Progress& progress) {
            options.progress = progress;
            return time_of_impact(a, motion_a.list[0], b, motion_b.list[0], options);
        }));
    std::vector<MotionPair> motions(size.size());
    for (std::size_t i = 0; i < motions.size(); ++i)
        motions[i] = {motion_a.list[motion_a.many ? i : 0], motion_b.list[motion_b.many ? i : 0]};
    return records(work.run([&](const Progress& progress) {
        options.progress = progress;
        return time_of_impact(a, b, motions, options);
    }));
}

py::class_<Motion> motion_class(py::module_& module) {
    return py::class_<Motion>(
               module, "Motion",
               "Motion(start, centre=(0, 0, 0), velocity=(0, 0, 0), angular_velocity=(0, 0, 0))\n\n"
               "How a body moves while t goes from 0 to 1: it turns about `centre` (a world point "
               "at t = "
               "0) at\n"
               "constant angular velocity (radians per unit of t), while the centre moves at "
               "constant "
               "velocity.")
        .def(py::init([](const py::object& start, const py::object& centre,
                         const py::object& velocity, const py::object& angular) {
                 return Motion{to_pose(start, "start"), to_vec3(centre, "centre"),
                               to_vec3(velocity, "velocity"), to_vec3(angular, "angular_velocity")};
             }),
             py::arg("start"), py::arg("centre") = py::make_tuple(0, 0, 0),
             py::arg("velocity") = py::make_tuple(0, 0, 0),
             py::arg("angular_velocity") = py::make_tuple(0, 0, 0))
        .def_static(
            "fixed", [](const py::object& pose) { return Motion::fixed(to_pose(pose, "pose")); },
            py::arg("pose"), "No motion.")
        .def_static(
            "between",
            [](const py::object& start, const py::object& end, const py::object& about) {
                const Vec3 centre = to_vec3(about, "about");
                return make_motions(start, end, [centre](const Pose& p, const Pose& q) {
                    return Motion::between(p, q, centre);
                });
            },
            py::arg("start"), py::arg("end"), py::arg("about") = py::make_tuple(0, 0, 0),
            "The body's point `about` moves in a straight line, and the body turns about it along "
            "the shortest\n"
            "arc. With arrays of shape (n, 4, 4) a list of motions.")
        .def_static(
            "screw",
            [](const py::object& start, const py::object& end) {
                return make_motions(start, end, &Motion::screw);
            },
            py::arg("start"), py::arg("end"),
            "Along the one screw that takes `start` to `end`. With arrays of shape (n, 4, 4) a "
            "list of motions.");
}

void add_motion_properties(py::class_<Motion>& type) {
    type.def_property_readonly("start", [](const Motion& motion) { return motion.start; })
        .def_property_readonly("centre", [](const Motion& motion) { return motion.centre; })
        .def_property_readonly("velocity", [](const Motion& motion) { return motion.velocity; })
        .def_property_readonly("angular_velocity",
                               [](const Motion& motion) { return motion.angular_velocity; })
        .def("__repr__", [](const Motion& motion) {
            return "Motion(start=" + std::string(py::repr(py::cast(motion.start))) +
                   ", centre=" + short_repr(py::cast(motion.centre)) +
                   ", velocity=" + short_repr(py::cast(motion.velocity)) +
                   ", angular_velocity=" + short_repr(py::cast(motion.angular_velocity)) + ")";
        });
}

} // namespace

void bind_motion(py::module_& module) {
    auto type = motion_class(module);
    add_motion_properties(type);
    module.def(
        "at", [](const Motion& motion, double t) { return at(motion, t); }, py::arg("motion"),
        py::arg("t"),
        "The matrix of shape (4, 4) to which the motion has taken the body at time t.");

    auto impact = RecordBinder<Impact>(module, "Impact",
                                       "Returned by time_of_impact. True if the models meet.");
    impact
        .field("meet", &Impact::meet, "whether they meet, to be safe also if that was not decided")
        .field("time", &Impact::time, "in [0, 1], never later than the first contact")
        .field("contact_time", &Impact::contact_time,
               "a time at which they are in contact; inf if none was found")
        .field("gap", &Impact::gap, "length: how far apart they are at `time`, at most")
        .field("point_a", &Impact::point_a, "closest point of a at `time`, world frame")
        .field("point_b", &Impact::point_b, "closest point of b at `time`, world frame")
        .field("normal", &Impact::normal, "unit vector from a to b; zero if they meet at the start")
        .field("triangle_a", &Impact::triangle_a, "triangle of a")
        .field("triangle_b", &Impact::triangle_b, "triangle of b")
        .field("status", &Impact::status,
               "Status; bound_only: it was not decided whether they touch")
        .field("out_of_steps", &Impact::out_of_steps, "whether max_steps ended the search")
        .field("steps", &Impact::steps, "steps of the search")
        .field("counters", &Impact::counters, "Counters");
    impact.done().def("__bool__", [](const Impact& self) { return self.meet; });

    add_verb(
        module, "time_of_impact",
        "time_of_impact(a, motion_a, b, motion_b, *, absolute_error=None, max_steps=None, "
        "progress=None)\n"
        "time_of_impact(surface_a, surface_b, *, absolute_error=0, thickness=0, progress=None)\n\n"
        "The first time in [0, 1] at which two moving models, or two Deformable, share a point.\n\n"
        "a, b                two Model\n"
        "motion_a, motion_b  a Motion, a pose (no motion), or a list of Motion; one is used with "
        "all of the other's\n"
        "absolute_error      length: how far apart the models may be at the time returned; None: a "
        "millionth of\n"
        "                    the smaller model's diagonal\n"
        "max_steps           limit of the search\n"
        "progress            function of (stage, fraction)\n\n"
        "Returns Impact; with lists of motions a record array of shape (n,), computed in parallel. "
        "Of deformables\n"
        "FeatureImpact, or None. Never later than the first contact. Raises Error (bad_argument) "
        "if a value is not\n"
        "finite; KeyboardInterrupt at Ctrl-C.");
    add_overload("time_of_impact",
                 {both<Model>,
                  {"a motion_a b motion_b * absolute_error max_steps progress", 4},
                  run_time_of_impact});
}

} // namespace abut::python
