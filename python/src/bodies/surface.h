#pragma once

#include <abut/deformable.h>

#include "support/work.h"

namespace abut::python {

/// A deformable as Python keeps it: queries of several threads may read it, one may change it.
struct Surface {
    Deformable value;
    InUse use;

    Surface(Mesh mesh, const DeformableOptions& options) : value(std::move(mesh), options) {}
};

/// Adds what representatives.h declares. Called by bind_deformable.
void bind_representatives(py::module_& module);

} // namespace abut::python
