#include <abut/robot.h>

#include "module.h"
#include "queries/queries.h"

namespace abut::python {

namespace {

/// One configuration, or several as rows of an array.
struct ConfigurationArgument {
    std::vector<double> values;
    bool many = false;
};

ConfigurationArgument to_configurations(py::handle object, const char* name, const Robot& robot) {
    const py::array_t<double> array = double_array(object, name);
    const auto width = static_cast<py::ssize_t>(robot.variables().size());
    if (array.ndim() < 1 || array.ndim() > 2 || array.shape(array.ndim() - 1) != width)
        throw py::value_error(std::string(name) + ": an array of shape (" + std::to_string(width) +
                              ",) or (n, " + std::to_string(width) + ") is wanted");
    return {{array.data(), array.data() + array.size()}, array.ndim() == 2};
}

/// The arguments that all queries of a robot share.
struct RobotQueryArguments {
    RobotQueryArguments(const Arguments& arguments, std::size_t place) {
        arguments.take(place, "self_pairs", query.self);
        if (arguments.has(place + 1))
            query.obstacles = get<RobotObstacles>(arguments[place + 1], "obstacles");
        arguments.take(place + 2, "root", query.root);
    }
    RobotQuery query;
};

py::object run_robot_collide(const Arguments& arguments) {
    const auto& robot = get<Robot>(arguments[0], "robot");
    const auto q = to_configurations(arguments[1], "configuration", robot);
    RobotQueryArguments asked(arguments, 2);
    Work work(arguments[5]);
    if (!q.many)
        return py::cast(work.run([&](const Progress& progress) {
            asked.query.progress = progress;
            return collide(robot, q.values, asked.query);
        }));
    return booleans(work.run([&](const Progress& progress) {
        asked.query.progress = progress;
        return collide(robot, Configurations{q.values}, asked.query);
    }));
}

py::object run_robot_distance(const Arguments& arguments) {
    const auto& robot = get<Robot>(arguments[0], "robot");
    const auto q = to_configurations(arguments[1], "configuration", robot);
    RobotQueryArguments asked(arguments, 2);
    RobotDistanceOptions options{asked.query};
    arguments.take(5, "upper_bound", options.upper_bound);
    Work work(arguments[6]);
    if (!q.many)
        return py::cast(work.run([&](const Progress& progress) {
            options.progress = progress;
            return distance(robot, q.values, options);
        }));
    return records(work.run([&](const Progress& progress) {
        options.progress = progress;
        return distance(robot, Configurations{q.values}, options);
    }));
}

py::object run_robot_impact(const Arguments& arguments) {
    const auto& robot = get<Robot>(arguments[0], "robot");
    const auto from = to_configurations(arguments[1], "start", robot);
    const auto to = to_configurations(arguments[2], "end", robot);
    RobotQueryArguments asked(arguments, 3);
    RobotImpactOptions options{asked.query};
    arguments.take(6, "absolute_error", options.absolute_error);
    std::optional<std::uint64_t> max_steps;
    arguments.take(7, "max_steps", max_steps);
    options.max_steps = max_steps.value_or(options.max_steps);
    Work work(arguments[8]);
    return py::cast(work.run([&](const Progress& progress) {
        options.progress = progress;
        return time_of_impact(robot, from.values, to.values, options);
    }));
}

bool is_robot(PyObject* first, PyObject* /*third*/) {
    return is_a<Robot>(first);
}

void bind_robot_values(py::module_& module) {
    PlainBinder<RobotVariable>(module, "RobotVariable", "A number that places a joint.")
        .field("name", &RobotVariable::name, "")
        .field("joint", &RobotVariable::joint, "index of its joint")
        .field("limits", &RobotVariable::limits, "JointLimits")
        .field("is_angle", &RobotVariable::is_angle, "radians, else metres")
        .done();
    PlainBinder<RobotObstacle>(
        module, "RobotObstacle",
        "RobotObstacle(name, model, pose=None)\n\nSomething that stands still around a robot.")
        .field("name", &RobotObstacle::name, "")
        .field("model", &RobotObstacle::model, "Model")
        .field("world_from_model", &RobotObstacle::world_from_model, "matrix of shape (4, 4)")
        .done()
        .def(py::init([](const std::string& name, const Model& model, const py::object& pose) {
                 return RobotObstacle{name, model, to_transform(pose, "pose")};
             }),
             py::arg("name"), py::arg("model"), py::arg("pose") = py::none());
    py::class_<RobotObstacles>(module, "RobotObstacles",
                               "RobotObstacles(obstacles)\n\nObstacles that are ready for queries: "
                               "made of RobotObstacle.")
        .def(py::init([](const std::vector<RobotObstacle>& obstacles) {
                 return RobotObstacles(obstacles);
             }),
             py::arg("obstacles"))
        .def_property_readonly("list", &RobotObstacles::list, "list of RobotObstacle");
    RecordBinder<RobotPair>(module, "RobotPair", "A link, and another link or an obstacle.")
        .field("link", &RobotPair::link, "index of a link")
        .field("other", &RobotPair::other, "index of a link, or of an obstacle")
        .field("is_obstacle", &RobotPair::is_obstacle, "whether `other` is an obstacle")
        .done();
    RecordBinder<RobotGap>(module, "RobotGap", "The nearest pair of a robot.")
        .field("distance", &RobotGap::distance, "metres; 0: a pair meets; inf: there is none")
        .field("pair", &RobotGap::pair, "RobotPair")
        .field("point_a", &RobotGap::point_a, "on the link, world frame")
        .field("point_b", &RobotGap::point_b, "on the other, world frame")
        .field("status", &RobotGap::status, "Status")
        .done();
    auto impact = RecordBinder<RobotImpact>(
        module, "RobotImpact", "The first contact on the way between two configurations.");
    impact.field("meet", &RobotImpact::meet, "whether a pair meets, or may meet")
        .field("time", &RobotImpact::time, "in [0, 1]; the way is free up to it")
        .field("contact_time", &RobotImpact::contact_time,
               "a time at which the pair is in contact; inf if none was found")
        .field("pair", &RobotImpact::pair, "RobotPair")
        .field("gap", &RobotImpact::gap, "metres: of the pair at `time`")
        .field("status", &RobotImpact::status, "Status; bound_only: contact was not decided")
        .field("steps", &RobotImpact::steps, "steps of the search");
    impact.done().def("__bool__", [](const RobotImpact& self) { return self.meet; });
}

void bind_robot_class(py::module_& module) {
    py::class_<Robot>(module, "Robot",
                      "Robot(description, *, allowed=(), allow_adjacent=True)\n\n"
                      "A robot that is ready for queries.\n\n"
                      "description     RobotDescription\n"
                      "allowed         AllowedPair of links that are not tested\n"
                      "allow_adjacent  whether links that a joint connects are left out, too")
        .def(py::init([](const RobotDescription& description,
                         const std::vector<AllowedPair>& allowed, bool adjacent) {
                 return Robot(description, {allowed, adjacent});
             }),
             py::arg("description"), py::kw_only(), py::arg("allowed") = std::vector<AllowedPair>(),
             py::arg("allow_adjacent") = true)
        .def_property_readonly("description", &Robot::description, "RobotDescription")
        .def_property_readonly("variables", &Robot::variables, "list of RobotVariable")
        .def_property_readonly("pairs", &Robot::pairs, "list of the pairs of links that are tested")
        .def(
            "default_configuration",
            [](const Robot& robot) { return numbers(robot.default_configuration()); },
            "Every variable is 0, or the limit that is nearest to 0.")
        .def(
            "link_transforms",
            [](const Robot& robot, const py::object& q) {
                return robot.link_transforms(to_configurations(q, "configuration", robot).values);
            },
            py::arg("configuration"), "Returns the matrix of every link.")
        .def(
            "beyond_limits",
            [](const Robot& robot, const py::object& q) {
                return robot.beyond_limits(to_configurations(q, "configuration", robot).values);
            },
            py::arg("configuration"), "Returns the indices of the variables beyond their limits.")
        .def("__repr__", [](const Robot& robot) {
            return "<abut.Robot '" + robot.description().name +
                   "': " + std::to_string(robot.variables().size()) + " variables>";
        });
}

} // namespace

void bind_robot(py::module_& module) {
    bind_robot_values(module);
    bind_robot_class(module);
    add_overload("collide", {is_robot,
                             {"robot configuration * self_pairs obstacles root progress", 2},
                             run_robot_collide});
    add_overload("distance",
                 {is_robot,
                  {"robot configuration * self_pairs obstacles root upper_bound progress", 2},
                  run_robot_distance});
    add_overload(
        "time_of_impact",
        {is_robot,
         {"robot start end * self_pairs obstacles root absolute_error max_steps progress", 3},
         run_robot_impact});
    module.def(
        "propose_allowed_pairs",
        [](const Robot& robot, std::uint64_t samples, std::uint64_t seed,
           const py::object& report) {
            Work work(report);
            return work.run([&](const Progress& progress) {
                return propose_allowed_pairs(robot, {samples, seed, progress});
            });
        },
        py::arg("robot"), py::kw_only(), py::arg("samples") = 10'000U, py::arg("seed") = 1U,
        py::arg("progress") = py::none(),
        "Proposes the pairs of links that need no test. Returns a list of AllowedPair.");
}

} // namespace abut::python
