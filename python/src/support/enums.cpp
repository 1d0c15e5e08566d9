#include "support/enums.h"

namespace abut::python {

void make_enum(py::module_& module, EnumClass& data, const char* name,
               const std::vector<std::string>& members, const char* doc) {
    py::list pairs;
    for (std::size_t i = 0; i < members.size(); ++i)
        pairs.append(py::make_tuple(members[i], i));
    data.name = name;
    data.type =
        py::module_::import("enum").attr("IntEnum")(name, pairs, py::arg("module") = "abut");
    data.type.attr("__doc__") = doc;
    data.members.clear();
    for (std::size_t i = 0; i < members.size(); ++i)
        data.members.push_back(data.type.attr(members[i].c_str()));
    module.attr(name) = data.type;
}

std::size_t enum_value(const EnumClass& data, py::handle object) {
    for (std::size_t i = 0; i < data.members.size(); ++i)
        if (object.is(data.members[i]))
            return i;
    if (PyUnicode_Check(object.ptr())) {
        const auto text = object.cast<std::string>();
        for (std::size_t i = 0; i < data.members.size(); ++i)
            if (data.members[i].attr("name").cast<std::string>() == text)
                return i;
        std::string names;
        for (const py::object& member : data.members)
            names += (names.empty() ? "" : ", ") + member.attr("name").cast<std::string>();
        throw py::value_error("'" + text + "' is no " + data.name + ": " + names);
    }
    const std::int64_t value = PyLong_Check(object.ptr()) ? PyLong_AsLong(object.ptr()) : -1;
    if (value < 0 || static_cast<std::size_t>(value) >= data.members.size()) {
        PyErr_Clear();
        throw py::type_error(std::string("a member of ") + data.name + " or its name is wanted");
    }
    return static_cast<std::size_t>(value);
}

} // namespace abut::python
