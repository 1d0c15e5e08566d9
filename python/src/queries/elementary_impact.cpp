#include <abut/elementary_impact.h>

#include "module.h"
#include "queries/queries.h"

namespace abut::python {

namespace {

/// Four vertices from twelve numbers.
std::array<Vec3, 4> four(const double* values) {
    std::array<Vec3, 4> points;
    for (std::size_t i = 0; i < 4; ++i)
        points[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return points;
}

py::array_t<double> vertices_of(const py::object& object, const char* name, bool many) {
    auto array = double_array(object, name);
    const bool right = many ? array.ndim() == 3 && array.shape(1) == 4 && array.shape(2) == 3
                            : array.ndim() == 2 && array.shape(0) == 4 && array.shape(1) == 3;
    if (!right)
        throw py::value_error(std::string(name) + ": an array of shape " +
                              (many ? "(n, 4, 3)" : "(4, 3)") + " is wanted");
    return array;
}

ElementaryOptions options_of(double absolute_error, double thickness) {
    return {.absolute_error = absolute_error, .thickness = thickness};
}

std::vector<ElementaryKind> kinds_of(const py::object& kinds, std::size_t count) {
    if (PyUnicode_Check(kinds.ptr()) || PyLong_Check(kinds.ptr()))
        return std::vector<ElementaryKind>(count, to_enum<ElementaryKind>(kinds));
    std::vector<ElementaryKind> list;
    for (const std::uint32_t kind : to_indices(kinds, "kinds"))
        list.push_back(to_enum<ElementaryKind>(py::int_(kind)));
    if (list.size() != count)
        throw py::value_error("kinds: there are " + std::to_string(list.size()) + ", but " +
                              std::to_string(count) + " pairs");
    return list;
}

py::object many_impacts(const py::object& kinds, const py::object& start, const py::object& end,
                        double absolute_error, double thickness, const py::object& report) {
    const auto from = vertices_of(start, "start", true), to = vertices_of(end, "end", true);
    if (from.shape(0) != to.shape(0))
        throw py::value_error("start and end are of different lengths");
    const auto list = kinds_of(kinds, static_cast<std::size_t>(from.shape(0)));
    std::vector<ElementaryPair> pairs(list.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
        pairs[i] = {list[i], four(from.data() + 12 * i), four(to.data() + 12 * i)};
    Work work(report);
    return records(work.run([&](const Progress& progress) {
        return elementary_impacts(pairs, options_of(absolute_error, thickness), progress);
    }));
}

py::object read_queries(const std::string& file, const py::object& kind) {
    const auto queries = read_elementary_queries(
        file, kind.is_none() ? std::nullopt : std::optional(to_enum<ElementaryKind>(kind)));
    const auto size = static_cast<py::ssize_t>(queries.pairs.size());
    std::vector<std::uint8_t> kinds;
    std::vector<std::array<Vec3, 4>> start, end;
    for (const ElementaryPair& pair : queries.pairs) {
        kinds.push_back(static_cast<std::uint8_t>(pair.kind));
        start.push_back(pair.start);
        end.push_back(pair.end);
    }
    return py::make_tuple(
        numbers(std::move(kinds)), own(std::move(start), py::dtype::of<double>(), {size, 4, 3}),
        own(std::move(end), py::dtype::of<double>(), {size, 4, 3}), booleans(queries.truth));
}

} // namespace

void bind_elementary_impact(py::module_& module) {
    bind_enum<ElementaryKind>(module, "ElementaryKind", {"vertex_face", "edge_edge"},
                              "Which features meet.");
    bind_enum<ElementaryStage>(module, "ElementaryStage", {"filter", "interval", "exact"},
                               "Who decided a test.");
    auto impact = RecordBinder<ElementaryImpact>(module, "ElementaryImpact",
                                                 "Returned by elementary_impact.");
    impact
        .field("meet", &ElementaryImpact::meet,
               "whether they share a point in [0, 1], or come within the thickness")
        .field("decided_by", &ElementaryImpact::decided_by, "ElementaryStage")
        .field("status", &ElementaryImpact::status, "Status")
        .field("time", &ElementaryImpact::time, "in [0, 1], never later than the first contact")
        .field("barycentric", &ElementaryImpact::barycentric,
               "weights in the face, or parameters on the edges")
        .field("normal", &ElementaryImpact::normal,
               "unit vector from the second feature towards the first");
    impact.done().def("__bool__", [](const ElementaryImpact& self) { return self.meet; });
    module.def(
        "elementary_impact",
        [](ElementaryKind kind, const py::object& start, const py::object& end,
           double absolute_error, double thickness) {
            return elementary_impact({kind, four(vertices_of(start, "start", false).data()),
                                      four(vertices_of(end, "end", false).data())},
                                     options_of(absolute_error, thickness));
        },
        py::arg("kind"), py::arg("start"), py::arg("end"), py::kw_only(),
        py::arg("absolute_error") = 0.0, py::arg("thickness") = 0.0,
        "elementary_impact(kind, start, end, *, absolute_error=0, thickness=0)\n\n"
        "The first time in [0, 1] at which a moving vertex and face, or two moving edges, share a "
        "point.\n\n"
        "kind            'vertex_face' or 'edge_edge'\n"
        "start, end      arrays of shape (4, 3): the vertex and the face's three, or the edges' "
        "two and two\n"
        "absolute_error  length; 0: exact. Else pairs that come so near may be reported too\n"
        "thickness       length at which features count as meeting\n\n"
        "Returns ElementaryImpact. Raises Error (bad_argument) if a value is not finite or "
        "negative.");
    module.def(
        "elementary_impacts", &many_impacts, py::arg("kinds"), py::arg("start"), py::arg("end"),
        py::kw_only(), py::arg("absolute_error") = 0.0, py::arg("thickness") = 0.0,
        py::arg("progress") = py::none(),
        "elementary_impacts(kinds, start, end, *, absolute_error=0, thickness=0, progress=None)\n\n"
        "Many pairs in parallel: start and end of shape (n, 4, 3), one kind for all or an array of "
        "shape (n,).\n\n"
        "Returns a record array of shape (n,) with the fields of ElementaryImpact.");
    module.def("read_elementary_queries", &read_queries, py::arg("file"),
               py::arg("kind") = py::none(),
               "Reads pairs from comma-separated text. Returns (kinds, start, end, truth): arrays "
               "of shapes (n,),\n"
               "(n, 4, 3), (n, 4, 3) and (n,), the last empty if the file does not tell.\n\n"
               "Raises Error: file_not_found, unreadable, malformed, bad_argument.");
}

} // namespace abut::python
