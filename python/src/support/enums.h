#pragma once

#include <abut/broad_phase.h>
#include <abut/clash.h>
#include <abut/convex.h>
#include <abut/deformable.h>
#include <abut/elementary_impact.h>
#include <abut/error.h>
#include <abut/rigid.h>
#include <abut/scene.h>
#include <abut/shape_queries.h>
#include <abut/store.h>
#include <abut/store_clash.h>
#include <abut/types.h>
#include <abut/volume.h>
#include <abut/walk.h>

#include "support/python.h"

#include <string>
#include <type_traits>
#include <vector>

/// Enumerations become classes derived from enum.IntEnum, so that they compare with the numbers in
/// arrays. An argument may be the member, its name or its number.
namespace abut::python {

struct EnumClass {
    const char* name = "";
    py::object type;                 ///< the class
    std::vector<py::object> members; ///< by value
};

/// The class of an enumeration. Never destroyed: the interpreter may end first.
template <class E>
EnumClass& enum_class() {
    static auto* data = new EnumClass;
    return *data;
}

/// Makes the class and its members, whose values are 0, 1, …
void make_enum(py::module_& module, EnumClass& data, const char* name,
               const std::vector<std::string>& members, const char* doc);
/// The member's number. Errors: TypeError, ValueError.
std::size_t enum_value(const EnumClass& data, py::handle object);

template <class E>
void bind_enum(py::module_& module, const char* name, const std::vector<std::string>& members,
               const char* doc) {
    make_enum(module, enum_class<E>(), name, members, doc);
}

template <class E>
E to_enum(py::handle object) {
    return static_cast<E>(enum_value(enum_class<E>(), object));
}

} // namespace abut::python

namespace pybind11::detail {

template <class E>
struct type_caster<E, enable_if_t<std::is_enum_v<E>>> {
    PYBIND11_TYPE_CASTER(E, const_name("enum"));
    bool load(handle source, bool /*convert*/) {
        value = abut::python::to_enum<E>(source);
        return true;
    }
    static handle cast(E member, return_value_policy /*policy*/, handle /*parent*/) {
        return abut::python::enum_class<E>().members.at(static_cast<std::size_t>(member)).inc_ref();
    }
};

} // namespace pybind11::detail
