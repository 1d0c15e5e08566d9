#pragma once

#include "support/python.h"

namespace abut::python {

/// Adds the plain values of abut/renderer.h: styles, marks, states of parts, colours by distance.
void bind_render_styles(py::module_& module);

} // namespace abut::python
