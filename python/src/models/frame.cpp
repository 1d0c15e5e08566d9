#include <abut/frame.h>

#include "models/scenes.h"
#include "module.h"
#include "support/arrays.h"
#include "support/meshes.h"

namespace abut::python {

void bind_frame(py::module_& module) {
    module.def(
        "read_frame", [](const py::object& path) { return read_frame(to_path(path)); },
        py::arg("path"),
        "Reads one frame of a deforming sequence, PLY or OBJ, as a Mesh: vertices as the file has "
        "them, in its order.\n\n"
        "Raises Error: file_not_found, unreadable, unsupported, malformed, bad_mesh.");
    module.def(
        "read_frame_positions",
        [](const py::object& path, std::size_t vertices, const py::object& faces) -> py::object {
            const auto positions =
                read_frame_positions(to_path(path), vertices, to_triangles(faces, vertices));
            return positions ? py::object(from_points(*positions)) : py::none();
        },
        py::arg("path"), py::arg("vertex_count"), py::arg("faces"),
        "The positions of a frame that has so many vertices and these faces, an array of shape (n, "
        "3); None if it has\n"
        "others. Errors as read_frame.");
    module.def(
        "write_frame",
        [](const py::object& mesh, const py::object& path) {
            write_frame(to_mesh_value(mesh, py::none()), to_path(path));
        },
        py::arg("mesh"), py::arg("path"),
        "Writes a frame as binary PLY. Takes what Model takes. Raises Error: unsupported, "
        "bad_mesh, cannot_write.");
}

} // namespace abut::python
