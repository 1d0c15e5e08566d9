#include <abut/model.h>

#include "module.h"
#include "support/arrays.h"
#include "support/enums.h"
#include "support/meshes.h"
#include "support/work.h"

#include <utility>

namespace abut::python {

namespace {

Model make_model(const py::object& source, const py::object& faces, Volume volume,
                 const py::object& report) {
    Mesh mesh = to_mesh_value(source, faces, report);
    Work work(report);
    return work.run([&](const Progress& progress) {
        return Model(std::move(mesh), ModelOptions{.volume = volume, .progress = progress});
    });
}

} // namespace

void bind_model(py::module_& module) {
    py::class_<Model>(
        module, "Model",
        "Model(vertices, faces, *, volume='automatic', progress=None)\nModel(path)\nModel(mesh)\n\n"
        "Triangles with the hierarchy that queries need. It never changes; any number of threads "
        "may\n"
        "query it.\n\n"
        "vertices  array of shape (n, 3), float32 or float64 in any order of memory; units are the "
        "caller's\n"
        "faces     array of shape (m, 3), int32, int64 or uint32, with indices from 0\n"
        "path      model file, read as by read_mesh: metres, all parts in one model\n"
        "mesh      a Mesh, or an object with .vertices and .faces (trimesh) or .points and "
        ".cells_dict\n"
        "          (meshio: triangles, and quadrilaterals cut in two)\n"
        "volume    a Volume, the bounding volume of the hierarchy\n"
        "progress  function of (stage, fraction), of reading a path\n\n"
        "The arrays are copied once. Raises Error: bad_mesh if an index is out of range or a "
        "coordinate is not\n"
        "finite or beyond 1e18; the codes of read_mesh for a path. KeyboardInterrupt at Ctrl-C.")
        .def(py::init(&make_model), py::arg("vertices"), py::arg("faces") = py::none(),
             py::kw_only(), py::arg("volume") = "automatic", py::arg("progress") = py::none())
        .def_property_readonly(
            "vertices",
            [](const py::object& self) {
                const auto& mesh = self.cast<const Model&>().mesh();
                return view_rows<double>(mesh.positions.data(), mesh.positions.size(), self);
            },
            "float64 array of shape (n, 3); it cannot be written to")
        .def_property_readonly(
            "faces",
            [](const py::object& self) {
                const auto& mesh = self.cast<const Model&>().mesh();
                return view_rows<std::uint32_t>(mesh.triangles.data(), mesh.triangles.size(), self);
            },
            "uint32 array of shape (m, 3); it cannot be written to")
        .def_property_readonly(
            "mesh", [](const Model& model) { return model.mesh(); }, "a copy of the mesh")
        .def_property_readonly("bytes", &Model::bytes, "memory of mesh and hierarchy")
        .def(py::pickle(
            [](const py::object& self) {
                return py::make_tuple(self.attr("vertices"), self.attr("faces"));
            },
            [](const py::tuple& state) {
                return make_model(state[0], state[1], Volume::automatic, py::none());
            }))
        .def("__repr__", [](const Model& model) {
            return "<abut.Model: " + std::to_string(model.mesh().positions.size()) + " vertices, " +
                   std::to_string(model.mesh().triangles.size()) + " triangles>";
        });
}

} // namespace abut::python
