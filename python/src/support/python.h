#pragma once

/// The headers of pybind11 that the module uses, in one place.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace abut::python {

namespace py = pybind11;

} // namespace abut::python
