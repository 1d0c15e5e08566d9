#pragma once

#include "support/arrays.h"
#include "support/enums.h"
#include "support/python.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

/// Functions that take models of several kinds. They are called without pybind11's conversions,
/// which would cost more than a short query.
namespace abut::python {

/// The arguments of one call, by the numbers of the parameters.
class Arguments {
public:
    static constexpr std::size_t kMost = 20;

    [[nodiscard]] bool has(std::size_t i) const noexcept {
        return values_[i] != nullptr && values_[i] != Py_None;
    }
    [[nodiscard]] py::handle operator[](std::size_t i) const noexcept {
        return values_[i] ? values_[i] : Py_None;
    }
    /// Sets `value` if the argument is given.
    void take(std::size_t i, const char* name, double& value) const {
        if (has(i))
            value = to_double((*this)[i], name);
    }
    void take(std::size_t i, const char* name, bool& value) const {
        if (has(i))
            value = to_bool((*this)[i], name);
    }
    void take(std::size_t i, const char* name, std::optional<double>& value) const {
        if (has(i))
            value = to_double((*this)[i], name);
    }
    void take(std::size_t i, const char* name, std::optional<std::uint64_t>& value) const;
    template <class E>
    requires std::is_enum_v<E>
    void take(std::size_t i, const char* /*name*/, E& value) const {
        if (has(i))
            value = to_enum<E>((*this)[i]);
    }

private:
    friend class Parameters;
    std::array<PyObject*, kMost> values_{}; ///< borrowed
};

/// The parameters of a function: "a pose_a b pose_b * mode progress". Those after the star are
/// given by name only; of the others the first `required` must be given.
class Parameters {
public:
    Parameters(const char* list, std::size_t required);
    /// Errors: TypeError.
    Arguments parse(const char* function, PyObject* const* values, Py_ssize_t count,
                    PyObject* names) const;
    [[nodiscard]] PyObject* name(std::size_t i) const { return names_.at(i); }

private:
    std::vector<PyObject*> names_; ///< interned strings, never freed
    std::size_t positional_ = 0, required_ = 0;
};

/// One meaning of a verb, for arguments of some types.
struct Overload {
    /// Returns whether it is meant. In: the first and the third argument; null if they are not
    /// given.
    bool (*accepts)(PyObject* first, PyObject* third) = nullptr;
    Parameters parameters;
    py::object (*run)(const Arguments& arguments) = nullptr;
};

/// Adds a function to the module; overloads follow, and are asked in their order.
void add_verb(py::module_& module, const char* name, const char* doc);
void add_overload(const char* verb, Overload overload);

/// The object of C++ behind one of Python, or null.
template <class T>
const T* peek(py::handle object) {
    if (!object)
        return nullptr;
    py::detail::type_caster_base<T> caster;
    if (!caster.load(object, false))
        return nullptr;
    return static_cast<const T*>(static_cast<T*>(caster));
}
template <class T>
T& get(py::handle object, const char* name) {
    if (auto* value = const_cast<T*>(object.is_none() ? nullptr : peek<T>(object)))
        return *value;
    throw py::type_error(std::string(name) + ": a " +
                         py::type::of<T>().attr("__name__").template cast<std::string>() +
                         " is wanted, not a " + Py_TYPE(object.ptr())->tp_name);
}
template <class T>
bool is_a(PyObject* object) {
    return object != nullptr && object != Py_None && peek<T>(object) != nullptr;
}

/// The number of queries that poses and the like ask together; none if they are one.
/// Errors: ValueError if they are of different numbers.
class BatchSize {
public:
    void add(bool many, std::size_t size, const char* name);
    [[nodiscard]] bool many() const noexcept { return size_.has_value(); }
    [[nodiscard]] std::size_t size() const noexcept { return size_.value_or(1); }

private:
    std::optional<std::size_t> size_;
};

} // namespace abut::python
