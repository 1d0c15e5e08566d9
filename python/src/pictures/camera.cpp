#include <abut/camera.h>

#include "module.h"
#include "support/arrays.h"
#include "support/records.h"

namespace abut::python {

void bind_camera(py::module_& module) {
    PlainBinder<Camera>(
        module, "Camera",
        "Camera(eye=(0, 0, 0), forward=(0, 1, 0), up=(0, 0, 1), *, field_of_view=pi/3,\n"
        "       width=1280, height=720, near=0.05, far=10000)\n\n"
        "A perspective camera. Lengths in metres, world frame; field_of_view is the vertical angle "
        "in\nradians, width and height are pixels of the picture.")
        .field("eye", &Camera::eye, "array of shape (3,)")
        .field("forward", &Camera::forward, "array of shape (3,): viewing direction")
        .field("up", &Camera::up, "array of shape (3,), not parallel to forward")
        .field("field_of_view", &Camera::field_of_view, "radians, in (0, pi)")
        .field("width", &Camera::width, "pixels")
        .field("height", &Camera::height, "pixels")
        .field("near", &Camera::near, "nearest distance that is seen")
        .field("far", &Camera::far, "farthest distance that is seen")
        .done()
        .def(py::init([](const py::object& eye, const py::object& forward, const py::object& up,
                         double field_of_view, std::uint32_t width, std::uint32_t height,
                         double near, double far) {
                 return Camera{to_vec3(eye, "eye"),
                               to_vec3(forward, "forward"),
                               to_vec3(up, "up"),
                               field_of_view,
                               width,
                               height,
                               near,
                               far};
             }),
             py::arg("eye") = py::make_tuple(0, 0, 0), py::arg("forward") = py::make_tuple(0, 1, 0),
             py::arg("up") = py::make_tuple(0, 0, 1), py::kw_only(),
             py::arg("field_of_view") = Camera{}.field_of_view, py::arg("width") = 1280U,
             py::arg("height") = 720U, py::arg("near") = 0.05, py::arg("far") = 10'000.0);
    module.def(
        "clip_from_world",
        [](const Camera& camera, const Vec3& origin) {
            py::array_t<float> matrix({4, 4});
            const std::array<float, 16> columns = clip_from_world(camera, origin);
            for (py::ssize_t row = 0; row < 4; ++row)
                for (py::ssize_t column = 0; column < 4; ++column)
                    matrix.mutable_at(row, column) =
                        columns[static_cast<std::size_t>(4 * column + row)];
            return py::array(matrix);
        },
        py::arg("camera"), py::arg("origin") = py::make_tuple(0, 0, 0),
        "Matrix of shape (4, 4), float32, from world minus `origin` to clip space (OpenGL).\n"
        "Raises Error (bad_argument) if the camera is not as its members say.");
    module.def("ray_through", &ray_through, py::arg("camera"), py::arg("x"), py::arg("y"),
               "The Ray from the eye through a pixel; (0, 0) is the top left corner of the "
               "picture.");
    module.def("length_of_pixel", &length_of_pixel, py::arg("camera"),
               "The length at distance 1 that a pixel covers, in the middle of the picture.");
    module.def("look_at_box", &look_at_box, py::arg("box"), py::arg("towards"), py::arg("up"),
               py::arg("lens") = Camera{},
               "The Camera that sees a whole Box3 from a direction: `towards` is where it looks.");
}

} // namespace abut::python
