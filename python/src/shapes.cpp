#include <abut/shapes.h>

#include "module.h"
#include "support/arrays.h"
#include "support/records.h"

namespace abut::python {

void bind_shapes(py::module_& module) {
    const double infinity = std::numeric_limits<double>::infinity();
    PlainBinder<Ray>(
        module, "Ray",
        "Ray(origin, direction, t_min=0, t_max=inf)\n\nThe points origin + t direction.")
        .field("origin", &Ray::origin, "array of shape (3,)")
        .field("direction", &Ray::direction, "array of shape (3,)")
        .field("t_min", &Ray::t_min, "in lengths of the direction")
        .field("t_max", &Ray::t_max, "in lengths of the direction")
        .done()
        .def(py::init([](const py::object& origin, const py::object& direction, double t_min,
                         double t_max) {
                 return Ray{to_vec3(origin, "origin"), to_vec3(direction, "direction"), t_min,
                            t_max};
             }),
             py::arg("origin"), py::arg("direction"), py::arg("t_min") = 0.0,
             py::arg("t_max") = infinity);
    PlainBinder<Segment>(module, "Segment", "Segment(a, b)\n\nA closed segment between two points.")
        .field("a", &Segment::a, "array of shape (3,)")
        .field("b", &Segment::b, "array of shape (3,)")
        .done()
        .def(py::init([](const py::object& a, const py::object& b) {
                 return Segment{to_vec3(a, "a"), to_vec3(b, "b")};
             }),
             py::arg("a"), py::arg("b"));
    PlainBinder<Sphere>(module, "Sphere", "Sphere(centre, radius)\n\nA closed ball.")
        .field("centre", &Sphere::centre, "array of shape (3,)")
        .field("radius", &Sphere::radius, "length, at least 0")
        .done()
        .def(py::init([](const py::object& centre, double radius) {
                 return Sphere{to_vec3(centre, "centre"), radius};
             }),
             py::arg("centre"), py::arg("radius"));
    PlainBinder<Capsule>(module, "Capsule",
                         "Capsule(axis, radius)\n\nAll points at most `radius` from a Segment.")
        .field("axis", &Capsule::axis, "Segment")
        .field("radius", &Capsule::radius, "length, at least 0")
        .done()
        .def(py::init([](const Segment& axis, double radius) {
                 return Capsule{axis, radius};
             }),
             py::arg("axis"), py::arg("radius"));
    PlainBinder<OrientedBox>(module, "OrientedBox",
                             "OrientedBox(box, pose)\n\nA solid Box3 in a frame of its own.")
        .field("box", &OrientedBox::box, "Box3")
        .field("pose", &OrientedBox::world_from_box, "matrix of shape (4, 4)")
        .done()
        .def(py::init([](const Box3& box, const py::object& pose) {
                 return OrientedBox{box, to_transform(pose, "pose")};
             }),
             py::arg("box"), py::arg("pose"));
}

} // namespace abut::python
