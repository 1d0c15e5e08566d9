#pragma once

#include <abut/scene.h>

#include "support/python.h"

#include <vector>

namespace abut::python {

/// Scenes from a list of them, or of paths, which are read.
std::vector<Scene> to_scenes(const py::object& models, const py::object& progress);
/// A path, with the suffixes of parse_model_path.
ModelPath to_model_path(py::handle path);
std::vector<ModelPath> to_model_paths(const py::object& paths);
std::string to_path(py::handle path);

} // namespace abut::python
