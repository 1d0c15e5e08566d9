#include <abut/error.h>

#include "module.h"
#include "support/enums.h"
#include "support/work.h"

namespace abut::python {

namespace {

py::object& error_type() {
    static auto* type = new py::object;
    return *type;
}

} // namespace

void set_python_error(const Error& error) {
    py::object exception = error_type()(error.what());
    exception.attr("code") = error.code();
    exception.attr("file") = error.file();
    PyErr_SetObject(error_type().ptr(), exception.ptr());
}

void bind_error(py::module_& module) {
    bind_enum<ErrorCode>(module, "ErrorCode",
                         {"bad_argument", "file_not_found", "unreadable", "malformed",
                          "unsupported", "bad_mesh", "reader_failed", "cannot_write",
                          "interrupted"},
                         "The kind of fault that an Error reports.");
    py::dict members;
    members["__doc__"] = "Bad data, failed input or output, and limits.\n\n"
                         "code: an ErrorCode. file: the file at fault, or an empty string.\n"
                         "Arguments of a wrong type or shape raise TypeError and ValueError.";
    members["__module__"] = "abut";
    members["code"] = ErrorCode::bad_argument;
    members["file"] = "";
    error_type() = py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(&PyType_Type))(
        "Error", py::make_tuple(py::reinterpret_borrow<py::object>(PyExc_RuntimeError)), members);
    module.attr("Error") = error_type();
    // The signature is pybind11's.
    py::register_exception_translator([](std::exception_ptr pointer) { // NOLINT
        try {
            if (pointer)
                std::rethrow_exception(pointer);
        } catch (const Error& error) {
            set_python_error(error);
        }
    });
}

} // namespace abut::python
