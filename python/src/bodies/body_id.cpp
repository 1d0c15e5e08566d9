#include <abut/body_id.h>

#include "bodies/bodies.h"

#include <unordered_map>

namespace abut::python {

namespace {

/// abut.BodyId, of which each world has a subclass whose attribute `world` is its number. So an id is no
/// larger than an int, and is made nearly as quickly. Never freed.
PyObject* id_class = nullptr;

/// The classes of living worlds by their numbers. Used with the interpreter's lock only.
std::unordered_map<std::uint32_t, py::object>& classes() {
    static auto* all = new std::unordered_map<std::uint32_t, py::object>;
    return *all;
}

/// The class that was asked about last; it is kept alive, so that no other one gets its address.
struct LastClass {
    py::object type;
    std::uint32_t world = 0;
};
LastClass& last_class() {
    static auto* last = new LastClass;
    return *last;
}

py::object make_class(std::uint32_t world) {
    py::dict members;
    members["__doc__"] = py::handle(id_class).attr("__doc__");
    members["__module__"] = "abut";
    members["__slots__"] = py::tuple();
    members["world"] = world;
    const py::handle type(reinterpret_cast<PyObject*>(&PyType_Type));
    return type("BodyId", py::make_tuple(py::handle(id_class)), members);
}

void remember(const py::object& type, std::uint32_t world) {
    last_class() = {type, world};
}

/// A read-only attribute that is computed from the number.
template <class Get>
py::object number_property(const char* doc, const Get& get) {
    const py::handle property(reinterpret_cast<PyObject*>(&PyProperty_Type));
    return property(py::cpp_function([get](const py::int_& id) { return get(body_of(id)); }),
                    py::none(), py::none(), doc);
}

} // namespace

PyObject* make_body_id(BodyId body) {
    if (last_class().world != body.world || !last_class().type) {
        py::object& type = classes()[body.world];
        if (!type)
            type = make_class(body.world);
        remember(type, body.world);
    }
    const auto number = py::reinterpret_steal<py::object>(PyLong_FromLongLong(number_of(body)));
    return number ? PyObject_CallOneArg(last_class().type.ptr(), number.ptr()) : nullptr;
}

std::uint32_t world_of(PyObject* id) {
    auto* type = reinterpret_cast<PyObject*>(Py_TYPE(id));
    if (type == last_class().type.ptr())
        return last_class().world;
    if (PyLong_CheckExact(id) ||
        !PyType_IsSubtype(Py_TYPE(id), reinterpret_cast<PyTypeObject*>(id_class)))
        return 0;
    const auto told = py::reinterpret_borrow<py::object>(type);
    remember(told, told.attr("world").cast<std::uint32_t>());
    return last_class().world;
}

void forget_ids(std::uint32_t world) {
    classes().erase(world);
    if (last_class().world == world)
        last_class() = {};
}

void bind_body_id(py::module_& module) {
    py::dict members;
    members["__doc__"] =
        "A body of a World: an int that knows its world.\n\n"
        "It is valid until the body is removed, and then never again. Another World refuses it. In "
        "an array it becomes a\n"
        "plain integer, which any World takes; so does a pickle of it.\n\n"
        "world  number of the World among those of the process; 0: not told";
    members["__module__"] = "abut";
    members["__slots__"] = py::tuple();
    members["world"] = 0;
    members["index"] = number_property(
        "int: below World.index_end(), so that an array of that length can be read by it",
        [](BodyId body) { return body.index; });
    members["generation"] = number_property("int: number of earlier bodies with this index",
                                            [](BodyId body) { return body.generation; });
    members["__reduce__"] = py::cpp_function(
        [](const py::int_& id) {
            return py::make_tuple(py::type::of(py::int_(0)), py::make_tuple(std::int64_t{id}));
        },
        py::is_method(module));
    const py::handle type(reinterpret_cast<PyObject*>(&PyType_Type));
    const py::handle integer(reinterpret_cast<PyObject*>(&PyLong_Type));
    id_class = type("BodyId", py::make_tuple(integer), members).release().ptr();
    module.attr("BodyId") = py::handle(id_class);
}

} // namespace abut::python
