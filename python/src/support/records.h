#pragma once

#include "support/arrays.h"
#include "support/enums.h"

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

/// Results that are plain structs: one becomes an object with attributes, many a numpy record array
/// whose fields are those attributes and whose memory is the vector's.
namespace abut::python {

struct Field {
    std::string name;
    std::size_t offset = 0;
    std::function<py::object()> format;
    std::function<py::object(const char*)> get;
};

template <class T>
struct RecordType {
    std::string name;
    std::vector<Field> fields;
    py::object dtype;
};

template <class T>
RecordType<T>& record_type() {
    static auto* type = new RecordType<T>;
    return *type;
}

/// How a type of C++ lies in a numpy array: the format, and the shape if it is an array itself. A struct
/// must be a record that was bound before.
template <class T, class = void>
struct FieldFormat {
    static py::object make() { return record_type<T>().dtype; }
};
template <class T>
struct FieldFormat<T, std::enable_if_t<std::is_arithmetic_v<T>>> {
    static py::object make() { return py::dtype::of<T>(); }
};
template <class T>
struct FieldFormat<T, std::enable_if_t<std::is_enum_v<T>>> {
    static py::object make() { return py::dtype::of<std::underlying_type_t<T>>(); }
};
template <>
struct FieldFormat<Vec3> {
    static py::object make() { return py::make_tuple(py::dtype::of<double>(), py::make_tuple(3)); }
};
template <class T, std::size_t N>
struct FieldFormat<std::array<T, N>> {
    static py::object make() { return py::make_tuple(py::dtype::of<T>(), py::make_tuple(N)); }
};

template <class T>
py::object to_python(const T& value) {
    return py::cast(value);
}
template <class T, std::size_t N>
requires std::is_arithmetic_v<T> py::array_t<T> to_python(const std::array<T, N>& value) {
    return py::array_t<T>(N, value.data());
}

/// What a property returns: what pybind11 converts by itself as it is, so that the signature in the
/// docstring, from which the type stubs are made, has its type.
template <class T>
auto property_value(const T& value) {
    if constexpr (std::is_same_v<decltype(to_python(value)), py::object>)
        return value;
    else
        return to_python(value);
}

/// Text of a value within another's: arrays as lists.
std::string short_repr(const py::object& value);

template <class T>
class RecordBinder {
public:
    RecordBinder(py::module_& module, const char* name, const char* doc)
        : class_(module, name, doc) {
        record_type<T>().name = name;
        class_.def("__repr__", [](const T& self) {
            std::string text = record_type<T>().name + "(";
            const char* comma = "";
            for (const Field& field : record_type<T>().fields) {
                text += comma + field.name + "=" +
                        short_repr(field.get(reinterpret_cast<const char*>(&self)));
                comma = ", ";
            }
            return text + ")";
        });
        class_.def("__eq__", [](const T& self, const py::object& other) -> py::object {
            if (!py::isinstance<T>(other))
                return py::reinterpret_borrow<py::object>(Py_NotImplemented);
            const T& right = other.cast<const T&>();
            for (const Field& field : record_type<T>().fields)
                if (!py::module_::import("numpy")
                         .attr("array_equal")(field.get(reinterpret_cast<const char*>(&self)),
                                              field.get(reinterpret_cast<const char*>(&right)))
                         .template cast<bool>())
                    return py::bool_(false);
            return py::bool_(true);
        });
    }

    template <class Class, class Member>
    RecordBinder& field(const char* name, Member Class::*member, const char* doc) {
        static const T example{};
        const auto offset =
            static_cast<std::size_t>(reinterpret_cast<const char*>(&(example.*member)) -
                                     reinterpret_cast<const char*>(&example));
        const auto get = [](const char* data) {
            return to_python(*reinterpret_cast<const Member*>(data));
        };
        record_type<T>().fields.push_back(
            {name, offset, [] { return FieldFormat<Member>::make(); },
             [offset, get](const char* self) { return get(self + offset); }});
        class_.def_property_readonly(
            name, [member](const T& self) { return to_python(self.*member); }, doc);
        return *this;
    }
    /// A field of a struct within the struct.
    template <class Inner, class Member>
    RecordBinder& inner(const char* name, Inner T::*outer, Member Inner::*member, const char* doc) {
        static const T example{};
        const auto offset =
            static_cast<std::size_t>(reinterpret_cast<const char*>(&(example.*outer.*member)) -
                                     reinterpret_cast<const char*>(&example));
        record_type<T>().fields.push_back({name, offset, [] { return FieldFormat<Member>::make(); },
                                           [offset](const char* self) {
                                               return to_python(
                                                   *reinterpret_cast<const Member*>(self + offset));
                                           }});
        class_.def_property_readonly(
            name, [outer, member](const T& self) { return to_python(self.*outer.*member); }, doc);
        return *this;
    }
    /// Ends the list of fields.
    py::class_<T>& done() {
        auto& type = record_type<T>();
        py::list names, formats, offsets;
        for (const Field& field : type.fields) {
            names.append(field.name);
            formats.append(field.format());
            offsets.append(field.offset);
        }
        py::dict layout;
        layout["names"] = names;
        layout["formats"] = formats;
        layout["offsets"] = offsets;
        layout["itemsize"] = sizeof(T);
        type.dtype = py::module_::import("numpy").attr("dtype")(layout);
        class_.attr("dtype") = type.dtype;
        return class_;
    }

private:
    py::class_<T> class_;
};

/// The vector as a numpy.recarray of shape (n,).
template <class T>
py::object records(std::vector<T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto size = static_cast<py::ssize_t>(values.size());
    const auto dtype = py::reinterpret_borrow<py::dtype>(record_type<T>().dtype);
    return own(std::move(values), dtype, {size})
        .attr("view")(py::module_::import("numpy").attr("recarray"));
}

/// A struct that is no record: its members are attributes.
template <class T>
class PlainBinder {
public:
    PlainBinder(py::module_& module, const char* name, const char* doc)
        : class_(module, name, doc) {
        prepare(name);
    }
    PlainBinder(py::handle scope, const char* name, const char* doc) : class_(scope, name, doc) {
        prepare(name);
    }

    template <class Class, class Member>
    PlainBinder& field(const char* name, Member Class::*member, const char* doc) {
        names().emplace_back(name);
        class_.def_property_readonly(
            name, [member](const T& self) { return property_value(self.*member); }, doc);
        return *this;
    }
    template <class Get>
    PlainBinder& property(const char* name, Get get, const char* doc) {
        names().emplace_back(name);
        class_.def_property_readonly(name, get, doc);
        return *this;
    }
    py::class_<T>& done() { return class_; }

private:
    static std::vector<std::string>& names() {
        static auto* list = new std::vector<std::string>;
        return *list;
    }
    void prepare(const char* name) {
        class_.def("__repr__", [name](const py::object& self) {
            std::string text = std::string(name) + "(";
            const char* comma = "";
            for (const std::string& field : names()) {
                text += comma + field + "=" + short_repr(self.attr(field.c_str()));
                comma = ", ";
            }
            return text + ")";
        });
    }
    py::class_<T> class_;
};

} // namespace abut::python
