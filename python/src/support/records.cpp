#include "support/records.h"

namespace abut::python {

std::string short_repr(const py::object& value) {
    constexpr std::size_t kLimit = 6; // items of a list that are shown
    if (is_array(value)) {
        const auto array = py::reinterpret_borrow<py::array>(value);
        if (array.ndim() == 1 && array.size() <= static_cast<py::ssize_t>(kLimit))
            return py::repr(array.attr("tolist")());
        std::string shape;
        for (py::ssize_t i = 0; i < array.ndim(); ++i)
            shape += (i ? ", " : "") + std::to_string(array.shape(i));
        return "<array (" + shape + ")>";
    }
    if (PyList_Check(value.ptr()) && py::len(value) > kLimit)
        return "<list of " + std::to_string(py::len(value)) + ">";
    if (py::hasattr(value, "name") && PyLong_Check(value.ptr()))
        return py::str(value.attr("name"));
    return py::repr(value);
}

} // namespace abut::python
