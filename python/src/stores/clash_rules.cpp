#include <abut/clash.h>
#include <abut/part_query.h>

#include "models/scenes.h"
#include "module.h"
#include "queries/queries.h"
#include "stores/clashes.h"

#include <algorithm>

namespace abut::python {

namespace {

bool is_path(py::handle object) {
    return PyUnicode_Check(object.ptr()) || py::hasattr(object, "__fspath__");
}

std::vector<ClashRule> to_rules(py::handle rules) {
    if (is_path(rules))
        return read_rules(to_path(rules));
    return rules.cast<std::vector<ClashRule>>();
}

PartQuery to_part_query(py::handle query) {
    if (!PyUnicode_Check(query.ptr()))
        return query.cast<PartQuery>();
    const auto text = query.cast<std::string>();
    return text.empty() ? PartQuery() : PartQuery::parse(text);
}

ClashMatrix to_matrix(py::handle matrix) {
    if (!is_path(matrix))
        return matrix.cast<ClashMatrix>();
    const std::string text = to_path(matrix);
    if (std::ranges::find(kMatrixPresets, text) != kMatrixPresets.end())
        return matrix_preset(text);
    return read_matrix(text);
}

void bind_queries(py::module_& module) {
    py::class_<PartQuery>(module, "PartQuery",
                          "PartQuery(text='')\n\n"
                          "A condition on parts (docs/selecting.md): 'type = IfcWall* and storey = "
                          "L2'. Without text it matches\n"
                          "every part. Raises Error: bad_argument.")
        .def(py::init([](const py::str& text) { return to_part_query(text); }),
             py::arg("text") = "")
        .def_property_readonly("text", &PartQuery::text, "in a canonical form")
        .def("matches", &PartQuery::matches, py::arg("scene"), py::arg("part"),
             "Whether a part of a Scene matches.")
        .def("empty", &PartQuery::empty, "Whether there is no condition.")
        .def("names", &PartQuery::names, "The names that it asks for.")
        .def("__eq__", [](const PartQuery& self, const PartQuery& other) { return self == other; })
        .def("__repr__", [](const PartQuery& self) { return "PartQuery(" + self.text() + ")"; });
    py::class_<ClashQuery>(module, "ClashQuery",
                           "ClashQuery(text='')\n\n"
                           "A condition on clashes and their parts: 'hard and storey = L2'. "
                           "Raises Error: bad_argument.")
        .def(py::init([](const std::string& text) {
                 return text.empty() ? ClashQuery() : ClashQuery::parse(text);
             }),
             py::arg("text") = "")
        .def_property_readonly("text", &ClashQuery::text, "in a canonical form")
        .def(
            "matches",
            [](const ClashQuery& self, const Report& report, std::size_t clash) {
                if (clash >= report.report.clashes.size())
                    throw py::index_error("there is no such clash");
                return self.matches(report.report.clashes[clash], *report.models);
            },
            py::arg("report"), py::arg("clash"),
            "Whether a clash of a ClashReport matches. It has no group and no topic; find() knows "
            "them.")
        .def(
            "find",
            [](const ClashQuery& self, const Report& report) {
                return self.find(report.report, *report.models);
            },
            py::arg("report"), "The indices of the clashes of a ClashReport that match.")
        .def("empty", &ClashQuery::empty, "Whether there is no condition.")
        .def("names", &ClashQuery::names, "The names that it asks for.")
        .def("asks_status", &ClashQuery::asks_status, "Whether it asks for a status.")
        .def("__repr__", [](const ClashQuery& self) { return "ClashQuery(" + self.text() + ")"; });
}

void bind_selectors(py::module_& module) {
    using Texts = std::vector<std::string>;
    PlainBinder<PartSelector>(module, "PartSelector",
                              "PartSelector(*, file=[], name=[], type=[], query='')\n\n"
                              "Which parts a rule means: all globs that are given must match (* "
                              "and ?), one of each list, and the PartQuery.")
        .field("file", &PartSelector::file, "")
        .field("name", &PartSelector::name, "")
        .field("type", &PartSelector::type, "")
        .field("query", &PartSelector::query, "PartQuery")
        .done()
        .def(py::init([](Texts file, Texts name, Texts type, const py::object& query) {
                 return PartSelector{std::move(file), std::move(name), std::move(type),
                                     to_part_query(query)};
             }),
             py::kw_only(), py::arg("file") = Texts{}, py::arg("name") = Texts{},
             py::arg("type") = Texts{}, py::arg("query") = "");
    PlainBinder<IgnoreRule>(
        module, "IgnoreRule",
        "IgnoreRule(*, same_file=False, same_type=False, same_name_prefix=0, neighbours=[])\n\n"
        "Pairs of parts that a rule leaves out.")
        .field("same_file", &IgnoreRule::same_file, "")
        .field("same_type", &IgnoreRule::same_type, "")
        .field("same_name_prefix", &IgnoreRule::same_name_prefix,
               "names that agree in so many first characters")
        .field("neighbours", &IgnoreRule::neighbours, "list of Neighbours")
        .done()
        .def(py::init([](bool same_file, bool same_type, std::size_t prefix,
                         std::vector<Neighbours> neighbours) {
                 return IgnoreRule{same_file, same_type, prefix, std::move(neighbours)};
             }),
             py::kw_only(), py::arg("same_file") = false, py::arg("same_type") = false,
             py::arg("same_name_prefix") = 0U, py::arg("neighbours") = std::vector<Neighbours>{});
}

void bind_rule(py::module_& module) {
    PlainBinder<ClashRule>(module, "ClashRule",
                           "ClashRule(name='', a=PartSelector(), b=PartSelector(), *, "
                           "clearance=None, touch_tolerance=None,\n"
                           "          ignore=IgnoreRule(), tolerated_depth=None, kinds=[], "
                           "severity='')\n\n"
                           "Selects pairs of parts, one side each, in either order. Lengths in "
                           "metres; None: those of the query.")
        .field("name", &ClashRule::name, "")
        .field("a", &ClashRule::a, "PartSelector")
        .field("b", &ClashRule::b, "PartSelector")
        .field("clearance", &ClashRule::clearance, "metres")
        .field("touch_tolerance", &ClashRule::touch_tolerance, "metres")
        .field("ignore", &ClashRule::ignore, "IgnoreRule")
        .field("tolerated_depth", &ClashRule::tolerated_depth,
               "metres; parts that meet no deeper are left out")
        .field("kinds", &ClashRule::kinds, "list of ClashKind that are reported; empty: all")
        .field("severity", &ClashRule::severity, "")
        .done()
        .def(py::init([](std::string name, PartSelector a, PartSelector b,
                         std::optional<double> clearance, std::optional<double> touch_tolerance,
                         IgnoreRule ignore, std::optional<double> tolerated_depth,
                         std::vector<ClashKind> kinds, std::string severity) {
                 return ClashRule{std::move(name), std::move(a),     std::move(b),
                                  clearance,       touch_tolerance,  std::move(ignore),
                                  tolerated_depth, std::move(kinds), std::move(severity)};
             }),
             py::arg("name") = "", py::arg("a") = PartSelector{}, py::arg("b") = PartSelector{},
             py::kw_only(), py::arg("clearance") = py::none(),
             py::arg("touch_tolerance") = py::none(), py::arg("ignore") = IgnoreRule{},
             py::arg("tolerated_depth") = py::none(), py::arg("kinds") = std::vector<ClashKind>{},
             py::arg("severity") = "");
    module.def(
        "read_rules", [](const py::object& path) { return read_rules(to_path(path)); },
        py::arg("path"),
        "Reads rules from JSON or TOML: a list of ClashRule. Raises Error: file_not_found, "
        "malformed.");
}

void bind_matrix(py::module_& module) {
    PlainBinder<ClashMatrix>(
        module, "ClashMatrix",
        "Groups of parts, and for pairs of groups whether and how their parts are examined.")
        .property(
            "groups",
            [](const ClashMatrix& self) {
                std::vector<std::pair<std::string, PartQuery>> groups;
                for (const ClashMatrix::Group& group : self.groups)
                    groups.emplace_back(group.name, group.select);
                return groups;
            },
            "pairs of name and PartQuery")
        .property(
            "cells",
            [](const ClashMatrix& self) {
                std::vector<std::tuple<std::uint32_t, std::uint32_t, bool, ClashRule>> cells;
                for (const ClashMatrix::Cell& cell : self.cells)
                    cells.emplace_back(cell.a, cell.b, cell.examined, cell.terms);
                return cells;
            },
            "tuples of two groups, whether their pairs are examined, and a ClashRule")
        .done();
    module.def(
        "read_matrix", [](const py::object& path) { return read_matrix(to_path(path)); },
        py::arg("path"),
        "Reads a ClashMatrix from JSON or TOML. Raises Error: file_not_found, malformed.");
    module.def(
        "matrix_preset", [](const std::string& name) { return matrix_preset(name); },
        py::arg("name"), "A ClashMatrix that Abut brings along. Raises Error: bad_argument.");
    module.def(
        "matrix_preset_text",
        [](const std::string& name) { return std::string(matrix_preset_text(name)); },
        py::arg("name"), "The TOML file of such a matrix. Raises Error: bad_argument.");
}

} // namespace

ClashOptions to_clash_options(const Arguments& arguments, std::size_t first) {
    ClashOptions options;
    arguments.take(first, "clearance", options.clearance);
    arguments.take(first + 1, "touch_tolerance", options.touch_tolerance);
    arguments.take(first + 2, "self", options.self);
    if (arguments.has(first + 3))
        options.rules = to_rules(arguments[first + 3]);
    return options;
}

void take_selection(const Arguments& arguments, std::size_t first, ClashOptions& options) {
    for (const auto& [place, query] :
         {std::pair<std::size_t, PartQuery*>{0, &options.only}, {1, &options.a}, {2, &options.b}})
        if (arguments.has(first + place))
            *query = to_part_query(arguments[first + place]);
    if (arguments.has(first + 3))
        options.matrix = to_matrix(arguments[first + 3]);
    if (arguments.has(first + 4))
        options.leave_out = py::handle(arguments[first + 4]).cast<std::vector<Neighbours>>();
    arguments.take(first + 5, "sort", options.order);
}

void bind_rules(py::module_& module) {
    bind_queries(module);
    bind_selectors(module);
    bind_rule(module);
    bind_matrix(module);
}

} // namespace abut::python
