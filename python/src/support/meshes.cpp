#include "support/meshes.h"

#include <abut/model.h>
#include <abut/scene.h>

#include "support/arrays.h"
#include "support/work.h"

namespace abut::python {

namespace {

bool is_path(const py::object& source) {
    return PyUnicode_Check(source.ptr()) || py::hasattr(source, "__fspath__");
}

Mesh from_arrays(const py::object& vertices, const py::object& faces) {
    Mesh mesh;
    mesh.positions = to_points(vertices, "vertices");
    mesh.triangles = to_triangles(faces, mesh.positions.size());
    return mesh;
}

/// Triangles and quadrilaterals, each of which becomes two triangles.
Mesh from_meshio(const py::object& source) {
    const py::dict cells = source.attr("cells_dict");
    Mesh mesh;
    mesh.positions = to_points(source.attr("points"), "points");
    if (cells.contains("triangle"))
        mesh.triangles = to_triangles(cells["triangle"], mesh.positions.size());
    if (cells.contains("quad")) {
        const py::object quads = py::array::ensure(cells["quad"]);
        const auto column = [&](const std::vector<int>& list) {
            const py::object chosen =
                quads.attr("__getitem__")(py::make_tuple(py::slice(0, py::len(quads), 1), list));
            return to_triangles(chosen, mesh.positions.size());
        };
        const auto first = column({0, 1, 2}), second = column({0, 2, 3});
        for (std::size_t i = 0; i < first.size(); ++i) {
            mesh.triangles.push_back(first[i]);
            mesh.triangles.push_back(second[i]);
        }
    }
    return mesh;
}

} // namespace

Mesh to_mesh_value(const py::object& source, const py::object& faces, py::handle report) {
    if (!faces.is_none())
        return from_arrays(source, faces);
    if (py::isinstance<Mesh>(source))
        return source.cast<const Mesh&>();
    if (py::isinstance<Model>(source))
        return source.cast<const Model&>().mesh();
    if (is_path(source)) {
        const auto path = py::module_::import("os").attr("fspath")(source).cast<std::string>();
        Work work(report);
        return work.run([&](const Progress& progress) {
            const ModelPath parsed = parse_model_path(path);
            ReadOptions options;
            options.progress = progress;
            return to_mesh(read_scene(parsed, options));
        });
    }
    if (py::hasattr(source, "vertices") && py::hasattr(source, "faces"))
        return from_arrays(source.attr("vertices"), source.attr("faces"));
    if (py::hasattr(source, "points") && py::hasattr(source, "cells_dict"))
        return from_meshio(source);
    throw py::type_error(
        "a mesh is wanted: vertices and faces, a path, a Mesh, a Model, or an object with "
        ".vertices and .faces or .points and .cells_dict");
}

} // namespace abut::python
