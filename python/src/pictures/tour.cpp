#include <abut/tour.h>

#include "models/scenes.h"
#include "module.h"
#include "support/arrays.h"
#include "support/records.h"

namespace abut::python {

void bind_tour(py::module_& module) {
    PlainBinder<TourPoint>(module, "TourPoint",
                           "TourPoint(seconds, eye, forward, up=(0, 0, 1), name='')\n\n"
                           "Where the camera is at a time.")
        .field("seconds", &TourPoint::seconds, "")
        .field("eye", &TourPoint::eye, "array of shape (3,)")
        .field("forward", &TourPoint::forward, "array of shape (3,)")
        .field("up", &TourPoint::up, "array of shape (3,)")
        .field("name", &TourPoint::name, "of a saved viewpoint; empty for others")
        .done()
        .def(py::init([](double seconds, const py::object& eye, const py::object& forward,
                         const py::object& up, const std::string& name) {
                 return TourPoint{seconds, to_vec3(eye, "eye"), to_vec3(forward, "forward"),
                                  to_vec3(up, "up"), name};
             }),
             py::arg("seconds"), py::arg("eye"), py::arg("forward"),
             py::arg("up") = py::make_tuple(0, 0, 1), py::arg("name") = "")
        .def("__eq__", [](const TourPoint& a, const TourPoint& b) { return a == b; });
    PlainBinder<Tour>(module, "Tour",
                      "Tour(points=[])\n\nViewpoints in the order of their times, or a path of the "
                      "camera.")
        .field("points", &Tour::points, "list of TourPoint")
        .done()
        .def(py::init([](const std::vector<TourPoint>& points) { return Tour{points}; }),
             py::arg("points") = std::vector<TourPoint>{})
        .def("__eq__", [](const Tour& a, const Tour& b) { return a == b; });
    module.def("duration", &duration, py::arg("tour"), "The time of the last point; 0 if none.");
    module.def("camera_at", &camera_at, py::arg("tour"), py::arg("seconds"),
               py::arg("lens") = Camera{},
               "The Camera at a time: the position on a Catmull-Rom spline through the points.\n\n"
               "lens  Camera with the field of view, size and clipping distances\n\n"
               "Raises Error (bad_argument) if the tour has no points or one is not valid.");
    module.def(
        "record",
        [](Tour& tour, double seconds, const Camera& camera, const std::string& name) {
            record(tour, seconds, camera, name);
        },
        py::arg("tour"), py::arg("seconds"), py::arg("camera"), py::arg("name") = "",
        "Appends a point, unless the last one without a name is less than 1/30 second older.\n"
        "Raises Error (bad_argument) if the time is before that of the last point.");
    module.def(
        "read_tour", [](const py::object& path) { return read_tour(to_path(path)); },
        py::arg("path"),
        "Reads a Tour from JSON. Raises Error: file_not_found, unreadable, malformed, "
        "unsupported.");
    module.def(
        "write_tour",
        [](const Tour& tour, const py::object& path) { write_tour(tour, to_path(path)); },
        py::arg("tour"), py::arg("path"),
        "Writes a Tour as JSON, atomically. Raises Error: bad_argument, cannot_write.");
}

} // namespace abut::python
