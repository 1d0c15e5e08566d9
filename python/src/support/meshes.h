#pragma once

#include <abut/mesh.h>

#include "support/python.h"

namespace abut::python {

/// A mesh from whatever tells one: a Mesh, a Model, a path, an object with `vertices` and `faces`
/// (trimesh), or with `points` and `cells_dict` (meshio); with `faces`, an array of positions.
///
/// In          report: progress of reading a path, as Work takes it.
///
/// Errors      TypeError, ValueError; Error{bad_mesh} for an index out of range; as read_mesh.
Mesh to_mesh_value(const py::object& source, const py::object& faces, py::handle report = {});

} // namespace abut::python
