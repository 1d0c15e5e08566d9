#include "support/arguments.h"

#include "support/work.h"

#include <memory>
#include <sstream>
#include <string_view>
#include <unordered_map>

namespace abut::python {

namespace {

struct Verb {
    std::string name, doc;
    std::vector<Overload> overloads;
    PyMethodDef definition{};
};

std::unordered_map<std::string, Verb*>& verbs() {
    static auto* all = new std::unordered_map<std::string, Verb*>;
    return *all;
}

/// The argument that is at this place, or has this name.
PyObject* argument(const Verb& verb, std::size_t place, PyObject* const* values, Py_ssize_t count,
                   PyObject* names) {
    if (static_cast<Py_ssize_t>(place) < count)
        return values[place];
    for (Py_ssize_t i = 0; names && i < PyTuple_GET_SIZE(names); ++i)
        for (const Overload& overload : verb.overloads)
            if (PyTuple_GET_ITEM(names, i) == overload.parameters.name(place))
                return values[count + i];
    return nullptr;
}

/// Whether an object is an abut.Mesh, or one of another package with the members of trimesh or meshio: a
/// Model can be made of it, but it is none.
bool looks_like_mesh(PyObject* object) {
    if (!object)
        return false;
    const std::string_view type = Py_TYPE(object)->tp_name;
    if (type.starts_with("abut.") && !type.ends_with(".Mesh"))
        return false;
    const auto has = [object](const char* name) {
        return PyObject_HasAttrString(object, name) != 0;
    };
    return (has("vertices") && has("faces")) || (has("points") && has("cells_dict"));
}

py::object call(const Verb& verb, PyObject* const* values, Py_ssize_t count, PyObject* names) {
    PyObject* first = argument(verb, 0, values, count, names);
    PyObject* third = argument(verb, 2, values, count, names);
    for (const Overload& overload : verb.overloads)
        if (overload.accepts(first, third))
            return overload.run(overload.parameters.parse(verb.name.c_str(), values, count, names));
    if (!first)
        throw py::type_error(verb.name + "() needs arguments: help(abut." + verb.name + ")");
    std::string types = Py_TYPE(first)->tp_name;
    if (third)
        types += std::string(" and ") + Py_TYPE(third)->tp_name;
    const bool is_mesh = looks_like_mesh(first) || looks_like_mesh(third);
    throw py::type_error(verb.name + "() is not for " + types + ": " +
                         (is_mesh ? "make an abut.Model of a mesh first; " : "") + "help(abut." +
                         verb.name + ")");
}

PyObject* call_verb(PyObject* self, PyObject* const* values, Py_ssize_t count, PyObject* names) {
    try {
        const Verb* verb = *static_cast<const Verb**>(PyModule_GetState(self));
        return call(*verb, values, count, names).release().ptr();
    } catch (py::error_already_set& error) {
        error.restore();
    } catch (const py::builtin_exception& error) {
        error.set_error();
    } catch (const Error& error) {
        set_python_error(error);
    } catch (const std::bad_alloc&) {
        PyErr_NoMemory();
    } catch (const std::exception& error) {
        PyErr_SetString(PyExc_RuntimeError, error.what());
    }
    return nullptr;
}

} // namespace

void Arguments::take(std::size_t i, const char* name, std::optional<std::uint64_t>& value) const {
    if (!has(i))
        return;
    const auto number = PyLong_Check(values_[i]) ? PyLong_AsUnsignedLongLong(values_[i]) : ~0ULL;
    if (!PyLong_Check(values_[i]) || PyErr_Occurred()) {
        PyErr_Clear();
        throw py::type_error(std::string(name) + ": an integer of at least 0 is wanted");
    }
    value = number;
}

Parameters::Parameters(const char* list, std::size_t required) : required_(required) {
    std::istringstream words(list);
    bool by_name = false;
    for (std::string word; words >> word;) {
        if (word == "*") {
            by_name = true;
            continue;
        }
        names_.push_back(PyUnicode_InternFromString(word.c_str()));
        positional_ += !by_name;
    }
    if (names_.size() > Arguments::kMost)
        throw std::logic_error("too many parameters");
}

Arguments Parameters::parse(const char* function, PyObject* const* values, Py_ssize_t count,
                            PyObject* names) const {
    Arguments arguments;
    if (count > static_cast<Py_ssize_t>(positional_))
        throw py::type_error(std::string(function) + "() takes " + std::to_string(positional_) +
                             " positional arguments but " + std::to_string(count) + " were given");
    for (Py_ssize_t i = 0; i < count; ++i)
        arguments.values_[static_cast<std::size_t>(i)] = values[i];
    for (Py_ssize_t k = 0; names && k < PyTuple_GET_SIZE(names); ++k) {
        PyObject* name = PyTuple_GET_ITEM(names, k);
        std::size_t i = 0;
        while (i < names_.size() && names_[i] != name)
            ++i;
        if (i == names_.size()) // a name that is not interned
            for (i = 0; i < names_.size() && PyUnicode_Compare(names_[i], name) != 0;)
                ++i;
        const std::string text = py::str(py::handle(name));
        if (i == names_.size())
            throw py::type_error(std::string(function) + "() got an unexpected keyword argument '" +
                                 text + "'");
        if (arguments.values_[i])
            throw py::type_error(std::string(function) + "() got multiple values for argument '" +
                                 text + "'");
        arguments.values_[i] = values[count + k];
    }
    for (std::size_t i = 0; i < required_; ++i)
        if (!arguments.values_[i])
            throw py::type_error(std::string(function) + "() missing argument '" +
                                 std::string(py::str(py::handle(names_[i]))) + "'");
    return arguments;
}

void add_verb(py::module_& module, const char* name, const char* doc) {
    auto* verb = new Verb{name, doc, {}, {}};
    verb->definition = {verb->name.c_str(),
                        reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(call_verb)),
                        METH_FASTCALL | METH_KEYWORDS, verb->doc.c_str()};
    verbs()[name] = verb;
    // A module, not a capsule, is what a function that can be pickled is called with.
    static PyModuleDef definition{
        PyModuleDef_HEAD_INIT,
        "abut",
        nullptr,
        sizeof(Verb*), // NOLINT(bugprone-sizeof-expression): a pointer is kept
        nullptr,
        nullptr,
        nullptr,
        nullptr,
        nullptr};
    const auto self = py::reinterpret_steal<py::object>(PyModule_Create(&definition));
    if (!self)
        throw py::error_already_set();
    *static_cast<const Verb**>(PyModule_GetState(self.ptr())) = verb;
    module.attr(name) = py::reinterpret_steal<py::object>(
        PyCFunction_NewEx(&verb->definition, self.ptr(), py::str("abut").ptr()));
}

void add_overload(const char* verb, Overload overload) {
    verbs().at(verb)->overloads.push_back(std::move(overload));
}

void BatchSize::add(bool many, std::size_t size, const char* name) {
    if (!many)
        return;
    if (size_ && *size_ != size)
        throw py::value_error(std::string(name) + ": there are " + std::to_string(size) + ", but " +
                              std::to_string(*size_) + " of what came before");
    size_ = size;
}

} // namespace abut::python
