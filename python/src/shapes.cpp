#include <abut/curved_shapes.h>
#include <abut/shapes.h>

#include "module.h"
#include "support/arrays.h"
#include "support/records.h"

namespace abut::python {

namespace {

void bind_curved_shapes(py::module_& module) {
    PlainBinder<Cylinder>(module, "Cylinder",
                          "Cylinder(axis, radius)\n\nThe solid between two discs of the same "
                          "radius across the ends of a Segment.")
        .field("axis", &Cylinder::axis, "Segment")
        .field("radius", &Cylinder::radius, "length, at least 0")
        .done()
        .def(py::init([](const Segment& axis, double radius) {
                 return Cylinder{axis, radius};
             }),
             py::arg("axis"), py::arg("radius"));
    PlainBinder<Cone>(module, "Cone",
                      "Cone(apex, base, radius)\n\nThe solid between an apex and a disc around "
                      "`base`, across the axis.")
        .field("apex", &Cone::apex, "array of shape (3,)")
        .field("base", &Cone::base, "array of shape (3,): centre of the disc")
        .field("radius", &Cone::radius, "length, at least 0")
        .done()
        .def(py::init([](const py::object& apex, const py::object& base, double radius) {
                 return Cone{to_vec3(apex, "apex"), to_vec3(base, "base"), radius};
             }),
             py::arg("apex"), py::arg("base"), py::arg("radius"));
    PlainBinder<Ellipsoid>(module, "Ellipsoid",
                           "Ellipsoid(centre, semi_axes)\n\nA solid ellipsoid along the axes of "
                           "its frame.")
        .field("centre", &Ellipsoid::centre, "array of shape (3,)")
        .field("semi_axes", &Ellipsoid::semi_axes, "array of shape (3,): lengths, at least 0")
        .done()
        .def(py::init([](const py::object& centre, const py::object& semi_axes) {
                 return Ellipsoid{to_vec3(centre, "centre"), to_vec3(semi_axes, "semi_axes")};
             }),
             py::arg("centre"), py::arg("semi_axes"));
    PlainBinder<HalfSpace>(module, "HalfSpace",
                           "HalfSpace(normal, offset)\n\nAll points x with normal . x <= offset.")
        .field("normal", &HalfSpace::normal, "array of shape (3,): points out of the solid")
        .field("offset", &HalfSpace::offset, "in lengths of the normal")
        .done()
        .def(py::init([](const py::object& normal, double offset) {
                 return HalfSpace{to_vec3(normal, "normal"), offset};
             }),
             py::arg("normal"), py::arg("offset"));
}

} // namespace

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
    bind_curved_shapes(module);
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
