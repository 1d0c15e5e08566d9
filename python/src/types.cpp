#include <abut/pose.h>
#include <abut/types.h>

#include "module.h"
#include "support/arrays.h"
#include "support/enums.h"
#include "support/records.h"

namespace abut::python {

namespace {

/// A function of points or vectors: of one, or of each row.
template <class Map>
py::array mapped(const py::object& points, const char* name, const Map& map) {
    PointArgument argument = to_point_or_points(points, name);
    if (!argument.many)
        return from_vec3(map(argument.one));
    for (Vec3& point : argument.list)
        point = map(point);
    return rows<double>(std::move(argument.list));
}

void add_pose_products(py::class_<Pose>& type) {
    type.def(
            "__mul__", [](const Pose& a, const Pose& b) { return a * b; }, py::arg("other"),
            py::is_operator(),
            "The pose that applies `other`, then this one. Its quaternion is of unit length.")
        .def(
            "inverse", [](const Pose& pose) { return inverse(pose); },
            "The Pose that undoes this one.")
        .def(
            "apply",
            [](const Pose& pose, const py::object& points) {
                return mapped(points, "points", [&](const Vec3& p) { return apply(pose, p); });
            },
            py::arg("points"),
            "Where the pose takes points: an array of shape (3,) or (n, 3), as the argument has.")
        .def(
            "rotate",
            [](const Pose& pose, const py::object& directions) {
                return mapped(directions, "directions",
                              [&](const Vec3& d) { return rotate(pose, d); });
            },
            py::arg("directions"), "As apply, but directions are only rotated.");
}

void bind_pose(py::module_& module) {
    py::class_<Pose> type(
        module, "Pose",
        "Pose(translation=(0, 0, 0), rotation=(1, 0, 0, 0))\n\n"
        "A rigid pose: x_world = R(rotation) x_model + translation. The quaternion (w, x, y, z)\n"
        "need not be of unit length.");
    type.def(py::init([](const py::object& translation, const py::object& rotation) {
                 Pose pose;
                 pose.translation = to_vec3(translation, "translation");
                 const auto q = double_array(rotation, "rotation");
                 if (q.ndim() != 1 || q.shape(0) != 4)
                     throw py::value_error("rotation: a quaternion (w, x, y, z) is wanted");
                 for (std::size_t i = 0; i < 4; ++i)
                     pose.rotation[i] = q.at(i);
                 return pose;
             }),
             py::arg("translation") = py::make_tuple(0, 0, 0),
             py::arg("rotation") = py::make_tuple(1, 0, 0, 0))
        .def_static(
            "from_matrix", [](const py::object& matrix) { return to_pose(matrix, "matrix"); },
            py::arg("matrix"),
            "The pose of a matrix of shape (4, 4). ValueError if it is no rotation and "
            "translation, to 1e-6.")
        .def(
            "matrix", [](const Pose& pose) { return Transform(pose); },
            "The matrix of shape (4, 4). Error if the quaternion has zero length.")
        .def_property_readonly("translation", [](const Pose& pose) { return pose.translation; })
        .def_property_readonly("rotation",
                               [](const Pose& pose) { return to_python(pose.rotation); })
        .def("__eq__",
             [](const Pose& a, const Pose& b) {
                 return a.translation == b.translation && a.rotation == b.rotation;
             })
        .def(py::pickle(
            [](const Pose& pose) {
                return py::make_tuple(pose.translation, to_python(pose.rotation));
            },
            [](const py::tuple& state) {
                Pose pose;
                pose.translation = to_vec3(state[0], "translation");
                const auto q = double_array(state[1], "rotation");
                for (std::size_t i = 0; i < 4; ++i)
                    pose.rotation[i] = q.at(i);
                return pose;
            }))
        .def("__repr__", [](const Pose& pose) {
            return "Pose(translation=" + short_repr(py::cast(pose.translation)) +
                   ", rotation=" + short_repr(to_python(pose.rotation)) + ")";
        });
    add_pose_products(type);
}

void bind_box(py::module_& module) {
    py::class_<Box3>(
        module, "Box3",
        "Box3(lower, upper)\n\nA closed axis-aligned box, from two points of shape (3,). Without\n"
        "arguments it is empty.")
        .def(py::init<>())
        .def(py::init([](const py::object& lower, const py::object& upper) {
                 return Box3{to_vec3(lower, "lower"), to_vec3(upper, "upper")};
             }),
             py::arg("lower"), py::arg("upper"))
        .def_property_readonly("lower", [](const Box3& box) { return box.lower; })
        .def_property_readonly("upper", [](const Box3& box) { return box.upper; })
        .def("__eq__", [](const Box3& a, const Box3& b) { return a == b; })
        .def("__repr__", [](const Box3& box) {
            return "Box3(lower=" + short_repr(py::cast(box.lower)) +
                   ", upper=" + short_repr(py::cast(box.upper)) + ")";
        });
}

} // namespace

void bind_types(py::module_& module) {
    bind_enum<Feature>(module, "Feature", {"vertex", "edge", "face"},
                       "The part of a triangle that a point belongs to.");
    bind_enum<Status>(
        module, "Status", {"exact", "converged", "bound_only"},
        "How far a result can be relied on.\n\n"
        "exact: the answer, numbers to double rounding. converged: within the error that was\n"
        "allowed. bound_only: the numbers are a proven bound.");

    bind_pose(module);
    bind_box(module);
}

} // namespace abut::python
