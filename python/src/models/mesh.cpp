#include <abut/mesh.h>

#include "module.h"
#include "support/arrays.h"
#include "support/meshes.h"
#include "support/records.h"

namespace abut::python {

void bind_mesh(py::module_& module) {
    py::class_<Mesh>(
        module, "Mesh",
        "Mesh(vertices, faces)\n\n"
        "Indexed triangles: vertices of shape (n, 3), faces of shape (m, 3) with indices from 0.\n"
        "Any object that Model takes may be given in place of both arrays. The arrays are "
        "copied.\n\n"
        "Raises Error (bad_mesh) if an index is out of range.")
        .def(py::init([](const py::object& vertices, const py::object& faces) {
                 return to_mesh_value(vertices, faces);
             }),
             py::arg("vertices"), py::arg("faces") = py::none())
        .def_property_readonly(
            "vertices",
            [](const py::object& self) {
                const auto& mesh = self.cast<const Mesh&>();
                return view_rows<double>(mesh.positions.data(), mesh.positions.size(), self);
            },
            "float64 array of shape (n, 3); it cannot be written to")
        .def_property_readonly(
            "faces",
            [](const py::object& self) {
                const auto& mesh = self.cast<const Mesh&>();
                return view_rows<std::uint32_t>(mesh.triangles.data(), mesh.triangles.size(), self);
            },
            "uint32 array of shape (m, 3); it cannot be written to")
        .def("__repr__", [](const Mesh& mesh) {
            return "<abut.Mesh: " + std::to_string(mesh.positions.size()) + " vertices, " +
                   std::to_string(mesh.triangles.size()) + " triangles>";
        });

    PlainBinder<MeshReport>(module, "MeshReport",
                            "Returned by inspect. Vertices at equal positions count as one.")
        .field("vertices", &MeshReport::vertices, "as stored")
        .field("distinct_vertices", &MeshReport::distinct_vertices,
               "after equal positions are merged")
        .field("triangles", &MeshReport::triangles, "as stored")
        .field("degenerate_triangles", &MeshReport::degenerate_triangles, "of exactly zero area")
        .field("duplicate_triangles", &MeshReport::duplicate_triangles,
               "beyond the first of the same positions")
        .field("boundary_edges", &MeshReport::boundary_edges, "used by one triangle")
        .field("nonmanifold_edges", &MeshReport::nonmanifold_edges,
               "used by three triangles or more")
        .field("flipped_edges", &MeshReport::flipped_edges,
               "used by two triangles in the same direction")
        .field("components", &MeshReport::components, "sets of triangles connected by vertices")
        .field("closed", &MeshReport::closed, "every edge is used by exactly two triangles")
        .field("bounds", &MeshReport::bounds, "Box3 of the vertices that a triangle uses");

    module.def(
        "inspect", [](const py::object& mesh) { return inspect(to_mesh_value(mesh, py::none())); },
        py::arg("mesh"),
        "inspect(mesh)\n\nCounts what a mesh has that may be wrong with it. Takes what Model "
        "takes.\n\n"
        "Returns a MeshReport. Raises Error (bad_mesh) if a coordinate is not finite or beyond "
        "1e18.");
}

} // namespace abut::python
