#pragma once

#include <abut/deformable.h>

#include "support/arguments.h"
#include "support/work.h"

#include <functional>
#include <string>

namespace abut::python {

/// A deformable as Python keeps it: queries of several threads may read it, one may change it.
struct Surface {
    Deformable value;
    InUse use;

    Surface(Mesh mesh, const DeformableOptions& options) : value(std::move(mesh), options) {}
};

constexpr const char* kSurface = "a deformable";

/// Runs a query of one surface. In: report, the number of the argument `progress`.
template <class Query>
auto read_one(const Arguments& arguments, std::size_t report, Query query) {
    auto& surface = get<Surface>(arguments[0], "surface");
    const InUse::Read read(surface.use, kSurface);
    Work work(arguments[report]);
    return work.run([&](const Progress& progress) { return query(surface.value, progress); });
}
/// Runs a query of two surfaces.
template <class Query>
auto read_two(const Arguments& arguments, std::size_t report, Query query) {
    auto& a = get<Surface>(arguments[0], "a");
    auto& b = get<Surface>(arguments[1], "b");
    const InUse::Read read_a(a.use, kSurface), read_b(b.use, kSurface);
    Work work(arguments[report]);
    return work.run([&](const Progress& progress) { return query(a.value, b.value, progress); });
}

/// Whether the first argument is a surface.
inline bool a_surface(PyObject* first, PyObject* /*third*/) {
    return is_a<Surface>(first);
}

/// Adds a function whose first argument is a surface. In: its parameters as Python writes them, how
/// many are required, and their list as Parameters takes it.
using AddQuery = std::function<void(const char* name, const char* parameters, std::size_t required,
                                    const char* list, const std::string& doc,
                                    py::object (*run)(const Arguments&))>;

/// Adds what is said of near features in deformable.h, and what surface_contacts.h and
/// constraint_colours.h declare. Called by bind_deformable.
void bind_near_results(py::module_& module);
void bind_near_queries(py::module_& module, const AddQuery& add);

/// Adds what representatives.h declares. Called by bind_deformable.
void bind_representatives(py::module_& module);

} // namespace abut::python
