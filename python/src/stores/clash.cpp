#include <abut/clash.h>

#include "models/scenes.h"
#include "module.h"
#include "queries/queries.h"
#include "stores/clashes.h"

namespace abut::python {

namespace {

std::vector<ClashRule> to_rules(py::handle rules) {
    if (PyUnicode_Check(rules.ptr()) || py::hasattr(rules, "__fspath__"))
        return read_rules(to_path(rules));
    return rules.cast<std::vector<ClashRule>>();
}

py::object run_find_clashes(const Arguments& arguments) {
    const auto progress_argument = py::reinterpret_borrow<py::object>(arguments[5]);
    ClashOptions options = to_clash_options(arguments, 1);
    auto models = to_scenes(py::reinterpret_borrow<py::object>(arguments[0]), progress_argument);
    Work work(progress_argument);
    auto report = work.run([&](const Progress& progress) {
        options.progress = progress;
        return find_clashes(models, options);
    });
    for (Scene& scene : models)
        scene.meshes = {};
    return py::cast(Report{
        std::move(report), std::make_shared<const std::vector<Scene>>(std::move(models)), {}});
}

bool anything(PyObject* first, PyObject* /*third*/) {
    return first != nullptr;
}

void bind_rules(py::module_& module) {
    using Texts = std::vector<std::string>;
    PlainBinder<PartSelector>(module, "PartSelector",
                              "PartSelector(*, file=[], name=[], type=[])\n\n"
                              "Which parts a rule means: all globs that are given must match (* "
                              "and ?), one of each list.")
        .field("file", &PartSelector::file, "")
        .field("name", &PartSelector::name, "")
        .field("type", &PartSelector::type, "")
        .done()
        .def(py::init([](Texts file, Texts name, Texts type) {
                 return PartSelector{std::move(file), std::move(name), std::move(type)};
             }),
             py::kw_only(), py::arg("file") = Texts{}, py::arg("name") = Texts{},
             py::arg("type") = Texts{});
    PlainBinder<IgnoreRule>(
        module, "IgnoreRule",
        "IgnoreRule(*, same_file=False, same_type=False, same_name_prefix=0)\n\n"
        "Pairs of parts that a rule leaves out.")
        .field("same_file", &IgnoreRule::same_file, "")
        .field("same_type", &IgnoreRule::same_type, "")
        .field("same_name_prefix", &IgnoreRule::same_name_prefix,
               "names that agree in so many first characters")
        .done()
        .def(py::init([](bool same_file, bool same_type, std::size_t prefix) {
                 return IgnoreRule{same_file, same_type, prefix};
             }),
             py::kw_only(), py::arg("same_file") = false, py::arg("same_type") = false,
             py::arg("same_name_prefix") = 0U);
    PlainBinder<ClashRule>(module, "ClashRule",
                           "ClashRule(name='', a=PartSelector(), b=PartSelector(), *, "
                           "clearance=None, touch_tolerance=None,\n"
                           "          ignore=IgnoreRule())\n\n"
                           "Selects pairs of parts, one side each, in either order. Lengths in "
                           "metres; None: those of the query.")
        .field("name", &ClashRule::name, "")
        .field("a", &ClashRule::a, "PartSelector")
        .field("b", &ClashRule::b, "PartSelector")
        .field("clearance", &ClashRule::clearance, "metres")
        .field("touch_tolerance", &ClashRule::touch_tolerance, "metres")
        .field("ignore", &ClashRule::ignore, "IgnoreRule")
        .done()
        .def(py::init([](std::string name, PartSelector a, PartSelector b,
                         std::optional<double> clearance, std::optional<double> touch_tolerance,
                         IgnoreRule ignore) {
                 return ClashRule{std::move(name), std::move(a),    std::move(b),
                                  clearance,       touch_tolerance, ignore};
             }),
             py::arg("name") = "", py::arg("a") = PartSelector{}, py::arg("b") = PartSelector{},
             py::kw_only(), py::arg("clearance") = py::none(),
             py::arg("touch_tolerance") = py::none(), py::arg("ignore") = IgnoreRule{});
    module.def(
        "read_rules", [](const py::object& path) { return read_rules(to_path(path)); },
        py::arg("path"),
        "Reads rules from JSON: a list of ClashRule. Raises Error: file_not_found, malformed.");
}

void bind_listed_clashes(py::module_& module) {
    PlainBinder<NamedClash>(module, "Clash",
                            "Two parts that clash. Lengths in metres, world frame of the report.")
        .property(
            "id", [](const NamedClash& clash) { return clash_id_text(clash.id); },
            "16 hexadecimal digits, the same in every run")
        .field("kind", &Clash::kind, "ClashKind")
        .field("distance", &Clash::distance, "negative: penetration")
        .field("part_ids", &NamedClash::ids, "ids of both parts")
        .field("names", &NamedClash::names, "names of both parts")
        .field("types", &NamedClash::types, "types of both parts")
        .field("files", &NamedClash::files, "files of both parts")
        .field("model", &Clash::model, "indices of both models")
        .field("part", &Clash::part,
               "indices of both parts in their models; of a store, in its report")
        .field("point_a", &Clash::point_a, "witness on the surface of a")
        .field("point_b", &Clash::point_b, "witness on the surface of b")
        .field("direction", &Clash::direction, "unit vector in which b moves to get away from a")
        .field("triangle_pairs", &Clash::triangle_pairs, "intersecting pairs of triangles")
        .field("rule", &Clash::rule, "name of the rule that decided")
        .field("status", &Clash::status, "ClashStatus, of a store alone")
        .field("note", &Clash::note, "of whoever reviewed it")
        .done();
    PlainBinder<ListedClash>(module, "ListedClash",
                             "A clash as a store lists it: in words, since its parts may be gone.")
        .property(
            "id", [](const ListedClash& clash) { return clash_id_text(clash.id); },
            "16 hexadecimal digits")
        .field("kind", &ListedClash::kind, "ClashKind")
        .field("status", &ListedClash::status, "ClashStatus")
        .field("distance", &ListedClash::distance, "metres")
        .field("part_ids", &ListedClash::part, "ids of both parts")
        .field("names", &ListedClash::name, "")
        .field("types", &ListedClash::type, "")
        .field("files", &ListedClash::file, "")
        .field("resolved", &ListedClash::resolved,
               "when it was found gone, in seconds since 1970; 0: it is there")
        .field("note", &ListedClash::note, "")
        .done();
}

void bind_report_writers(py::module_& module) {
    const auto to_text = [](const Report& self) {
        if (!self.counters)
            return to_json(self.report, *self.models);
        return to_json(StoreClashReport{self.report, *self.models, *self.counters});
    };
    module.def("to_json", to_text, py::arg("report"),
               "The JSON text that the command writes: of a ClashReport, of a ClashReview, or of a "
               "list of ClashReview and the path\n"
               "of their store.");
    const auto add_writer = [&module](const char* name, const char* doc,
                                      void (*write)(const ClashReport&, const std::vector<Scene>&,
                                                    const std::string&)) {
        module.def(
            name,
            [write](const Report& report, const py::object& path) {
                write(report.report, *report.models, to_path(path));
            },
            py::arg("report"), py::arg("path"), doc);
    };
    add_writer("write_clash_json", "Writes a report as JSON. Raises Error (cannot_write).",
               &write_clash_json);
    add_writer("write_clash_csv",
               "Writes a report as comma-separated text. Raises Error (cannot_write).",
               &write_clash_csv);
    add_writer("write_clash_html",
               "Writes a report as one page of HTML. Raises Error (cannot_write).",
               &write_clash_html);
}

void bind_model_summary(py::module_& module) {
    PlainBinder<ClashReport::ModelSummary>(module, "ModelSummary", "A model of a ClashReport.")
        .field("file", &ClashReport::ModelSummary::file, "")
        .field("parts", &ClashReport::ModelSummary::parts, "")
        .field("triangles", &ClashReport::ModelSummary::triangles, "each instance counted")
        .field("unit", &ClashReport::ModelSummary::unit, "metres per unit of the file")
        .field("up", &ClashReport::ModelSummary::up, "UpAxis of the file")
        .field("notes", &ClashReport::ModelSummary::notes, "list of SceneNote")
        .done();
}

void bind_results(py::module_& module) {
    bind_listed_clashes(module);
    bind_model_summary(module);
    const auto counts = [](const Report& self) {
        py::dict dict;
        for (const ClashKind kind : kClashKinds)
            dict[to_string(kind)] = self.report.counts[static_cast<std::size_t>(kind)];
        return dict;
    };
    const auto statuses = [](const Report& self) -> py::object {
        if (!self.report.statuses)
            return py::none();
        py::dict dict;
        for (const ClashStatus status : kClashStatuses)
            dict[to_string(status)] = (*self.report.statuses)[static_cast<std::size_t>(status)];
        return dict;
    };
    const auto seconds = [](const Report& self) {
        py::dict times;
        const auto& s = self.report.seconds;
        times["import"] = s.import;
        times["build"] = s.build;
        times["broad"] = s.broad;
        times["narrow"] = s.narrow;
        times["total"] = s.total;
        return times;
    };
    PlainBinder<Report>(module, "ClashReport",
                        "Returned by find_clashes. Its length is the number of clashes.")
        .property("clashes", &named_clashes, "list of Clash, sorted by model, part of a, then of b")
        .property("counts", counts, "dict of kind to number")
        .property(
            "models", [](const Report& self) { return self.report.models; }, "list of ModelSummary")
        .property(
            "up", [](const Report& self) { return self.report.frame.up; }, "UpAxis of all points")
        .property(
            "warnings", [](const Report& self) { return self.report.warnings; },
            "list of str: what makes the result doubtful")
        .property(
            "clearance", [](const Report& self) { return self.report.clearance; }, "metres")
        .property(
            "touch_tolerance", [](const Report& self) { return self.report.touch_tolerance; },
            "metres")
        .property(
            "candidates", [](const Report& self) { return self.report.candidates; },
            "pairs of parts whose boxes are near")
        .property("statuses", statuses, "dict of status to number, of a store; else None")
        .property(
            "resolved", [](const Report& self) { return self.report.resolved; },
            "list of ListedClash, of a store")
        .property(
            "counters", [](const Report& self) { return self.counters; },
            "OutOfCoreCounters, of a store; else None")
        .property("seconds", seconds, "dict of stage to seconds")
        .property(
            "peak_rss_mib", [](const Report& self) { return self.report.peak_rss_mib; }, "MiB")
        .done()
        .def("__len__", [](const Report& self) { return self.report.clashes.size(); });
    bind_report_writers(module);
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

std::vector<NamedClash> named_clashes(const Report& report) {
    std::vector<NamedClash> list;
    for (const Clash& clash : report.report.clashes) {
        NamedClash named{clash, {}, {}, {}, {}};
        for (std::size_t side = 0; side < 2; ++side) {
            const Scene& scene = report.models->at(clash.model[side]);
            const Part& part = scene.parts.at(clash.part[side]);
            named.ids[side] = part.id;
            named.names[side] = part.name;
            named.types[side] = part.type;
            named.files[side] = scene.file;
        }
        list.push_back(std::move(named));
    }
    return list;
}

void bind_clash(py::module_& module) {
    std::vector<std::string> kinds;
    kinds.reserve(kClashKinds.size());
    for (const ClashKind kind : kClashKinds)
        kinds.emplace_back(to_string(kind));
    bind_enum<ClashKind>(module, "ClashKind", kinds, "docs/clash.md defines each kind.");
    bind_enum<ClashStatus>(module, "ClashStatus",
                           {"fresh", "active", "reviewed", "approved", "resolved"},
                           "What has become of a clash between the jobs of a store.");
    bind_rules(module);
    bind_results(module);
    add_verb(
        module, "find_clashes",
        "find_clashes(models, *, clearance=0, touch_tolerance=0, self=False, rules=[], "
        "progress=None)\n"
        "find_clashes(store, *, clearance=0, touch_tolerance=0, self=False, rules=[], "
        "progress=None,\n"
        "             memory=512 MiB, order='partition', keep=True, keep_hierarchies=True, "
        "crew=None)\n\n"
        "All clashes and clearances between the parts of different models; of one model, between "
        "its parts.\n\n"
        "models            list of Scene or paths, or one of them\n"
        "store             an open Store: models of any size in little memory\n"
        "clearance         metres; pairs without contact that are nearer are reported\n"
        "touch_tolerance   metres; surfaces that meet no deeper than this are of kind touch\n"
        "self              also the pairs within each model\n"
        "rules             list of ClashRule, or the path of a JSON file\n"
        "progress          function of (stage, fraction)\n"
        "memory            bytes for geometry, hierarchies and tables\n"
        "order             a WorkOrder\n"
        "keep              whether what is done is kept in the store, if that can be written to\n"
        "keep_hierarchies  whether hierarchies are kept with it\n"
        "crew              a Crew: the processes that do the job together, this one as their "
        "leader\n\n"
        "Returns a ClashReport. Raises Error: bad_argument for a negative length, those of "
        "read_scene and of the store;\n"
        "KeyboardInterrupt at Ctrl-C.");
}

/// After the overload for stores, which is asked first.
void bind_clash_of_scenes() {
    add_overload("find_clashes", {anything,
                                  {"models * clearance touch_tolerance self rules progress", 1},
                                  run_find_clashes});
}

} // namespace abut::python
