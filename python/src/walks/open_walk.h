#pragma once

#include <abut/walk.h>

#include "queries/queries.h"
#include "stores/open_store.h"

namespace abut::python {

/// Parts of a walk are their numbers.
template <>
struct FieldFormat<WalkPart> {
    static py::object make() { return py::dtype::of<std::int64_t>(); }
};
template <>
inline py::object to_python<WalkPart>(const WalkPart& part) {
    return py::int_(part.number);
}

/// A walk, which one thread at a time uses.
class OpenWalk {
public:
    OpenWalk(const OpenStore& store, const WalkOptions& options)
        : walk_(make(store.get(), options)) {}

    /// Calls `use(walk)` without the interpreter's lock.
    template <class Use>
    auto run(Use use) {
        const InUse::Change change(use_, "the walk");
        const py::gil_scoped_release unlocked;
        return use(walk_);
    }
    /// The same for a query that can be stopped: `query(walk, progress)`.
    template <class Query>
    auto query(Query query, py::handle report = {}) {
        const InUse::Change change(use_, "the walk");
        Work work(report);
        return work.run([&](const Progress& progress) { return query(walk_, progress); });
    }

private:
    static Walk make(const Store& store, const WalkOptions& options) {
        const py::gil_scoped_release unlocked;
        return Walk(store, options);
    }
    Walk walk_;
    InUse use_;
};

/// A probe, or a shape that one is made of.
Probe to_probe(const py::object& shape);

inline WalkQuery query_of(MissingParts missing, std::int64_t except) {
    WalkQuery query;
    query.missing = missing;
    query.except = {except};
    return query;
}

inline py::array part_numbers(const std::vector<WalkPart>& parts) {
    std::vector<std::int64_t> list;
    list.reserve(parts.size());
    for (const WalkPart part : parts)
        list.push_back(part.number);
    return numbers(std::move(list));
}

void bind_walk_results(py::module_& module);

} // namespace abut::python
