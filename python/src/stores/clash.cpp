#include <abut/clash.h>

#include "models/scenes.h"
#include "module.h"
#include "queries/queries.h"
#include "stores/clashes.h"
#include "stores/open_store.h"
#include "support/work.h"

namespace abut::python {

namespace {

py::object run_find_clashes(const Arguments& arguments) {
    const auto progress_argument = py::reinterpret_borrow<py::object>(arguments[5]);
    ClashOptions options = to_clash_options(arguments, 1);
    take_selection(arguments, 6, options);
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

void run_write_html(const Report& report, const py::object& path, const py::object& models,
                    std::uint64_t building_bytes, const py::object& progress) {
    ClashPageOptions options{building_bytes, {}};
    const std::string file = to_path(path);
    if (py::isinstance<OpenStore>(models)) {
        const Store store = models.cast<const OpenStore&>().get();
        const StoreClashReport found{report.report, *report.models, {}};
        Work work(progress);
        work.run([&](const Progress& reported) {
            options.progress = reported;
            write_clash_html(found, store, file, options);
            return true;
        });
        return;
    }
    const std::vector<Scene> scenes =
        models.is_none() ? *report.models : to_scenes(models, progress);
    Work work(progress);
    work.run([&](const Progress& reported) {
        options.progress = reported;
        write_clash_html(report.report, scenes, file, options);
        return true;
    });
}

bool anything(PyObject* first, PyObject* /*third*/) {
    return first != nullptr;
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
        .field("rule", &Clash::rule, "name of the rule or cell that decided")
        .field("severity", &Clash::severity, "of that rule or cell")
        .field("volume", &Clash::volume, "cubic metres that two solids have in common")
        .field("volume_error", &Clash::volume_error, "bound of its error")
        .field("rounding", &Clash::rounding, "metres by which the coordinates of both are rounded")
        .field("neighbours", &Clash::neighbours, "Neighbours: how the parts belong together")
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
    module.def(
        "write_clash_html", &run_write_html, py::arg("report"), py::arg("path"),
        py::arg("models") = py::none(), py::kw_only(),
        py::arg("building_bytes") = ClashPageOptions().building_bytes,
        py::arg("progress") = py::none(),
        "Writes a report as one page of HTML, with the building in 3D if the models are given.\n\n"
        "models           what the report is about: list of Scene or paths, or a Store\n"
        "building_bytes   of the page for the 3D view, approximately; 0: no 3D view\n\n"
        "Raises Error: cannot_write, bad_argument, those of the store.");
}

/// Returns a dict of name to number.
template <typename Value, std::size_t count>
py::dict to_dict(const std::array<std::uint64_t, count>& numbers,
                 const std::array<Value, count>& values) {
    py::dict dict;
    for (const Value value : values)
        dict[to_string(value)] = numbers[static_cast<std::size_t>(value)];
    return dict;
}

void bind_matrix_of_report(py::module_& module) {
    using Matrix = ClashReport::Matrix;
    PlainBinder<Matrix::Cell>(module, "MatrixCell", "A cell of a report's Matrix.")
        .field("a", &Matrix::Cell::a, "index of a group")
        .field("b", &Matrix::Cell::b, "index of a group")
        .field("examined", &Matrix::Cell::examined, "")
        .field("clearance", &Matrix::Cell::clearance, "metres")
        .field("severity", &Matrix::Cell::severity, "")
        .property(
            "counts", [](const Matrix::Cell& cell) { return to_dict(cell.counts, kClashKinds); },
            "dict of kind to number")
        .done();
    PlainBinder<Matrix>(module, "Matrix", "The clashes of a ClashReport by groups of parts.")
        .field("groups", &Matrix::groups, "names")
        .field("cells", &Matrix::cells, "list of MatrixCell")
        .done();
}

void bind_model_summary(py::module_& module) {
    PlainBinder<ClashReport::Surfaces::Named>(module, "NamedSurface",
                                              "A part of a ClashReport that bounds no solid.")
        .field("model", &ClashReport::Surfaces::Named::model, "index of its model")
        .field("id", &ClashReport::Surfaces::Named::id, "")
        .field("name", &ClashReport::Surfaces::Named::name, "")
        .field("type", &ClashReport::Surfaces::Named::type, "")
        .done();
    PlainBinder<ClashReport::Surfaces>(module, "Surfaces",
                                       "The parts of a ClashReport that bound no solid.")
        .field("count", &ClashReport::Surfaces::count, "number of them")
        .field("first", &ClashReport::Surfaces::first,
               "list of NamedSurface: the first 100 of them")
        .done();
    PlainBinder<ClashReport::ModelSummary>(module, "ModelSummary", "A model of a ClashReport.")
        .field("file", &ClashReport::ModelSummary::file, "")
        .field("parts", &ClashReport::ModelSummary::parts, "")
        .field("triangles", &ClashReport::ModelSummary::triangles, "each instance counted")
        .field("unit", &ClashReport::ModelSummary::unit, "metres per unit of the file")
        .field("up", &ClashReport::ModelSummary::up, "UpAxis of the file")
        .field("notes", &ClashReport::ModelSummary::notes, "list of SceneNote")
        .field("precision", &ClashReport::ModelSummary::precision, "metres, as the file states it")
        .field("rounding", &ClashReport::ModelSummary::rounding,
               "metres; the largest rounding of the coordinates of a part")
        .done();
}

py::dict seconds_of(const Report& self) {
    py::dict times;
    const auto& s = self.report.seconds;
    times["import"] = s.import;
    times["build"] = s.build;
    times["broad"] = s.broad;
    times["narrow"] = s.narrow;
    times["total"] = s.total;
    return times;
}

void bind_memory_and_groups_of_report(PlainBinder<Report>& binder) {
    binder
        .property(
            "resolved", [](const Report& self) { return self.report.resolved; },
            "list of ListedClash, of a store")
        .property(
            "grouping", [](const Report& self) { return self.report.grouping; },
            "list of GroupBy; empty: not grouped")
        .property(
            "groups", [](const Report& self) { return self.report.groups; },
            "list of ClashGroup, once group_clashes was called")
        .property(
            "history", [](const Report& self) { return self.report.history; },
            "list of JobCounts, of a store that was grouped")
        .property(
            "topics", [](const Report& self) { return self.report.topics; },
            "list of Topic, of a store that was grouped")
        .property(
            "topics_revision", [](const Report& self) { return self.report.topics_revision; },
            "number of their last change");
}

void bind_touch_of_report(PlainBinder<Report>& binder) {
    binder
        .property(
            "touch_tolerance", [](const Report& self) { return self.report.touch_tolerance; },
            "metres; the largest one if pairs differ")
        .property(
            "least_touch_tolerance",
            [](const Report& self) { return self.report.least_touch_tolerance; },
            "metres; the smallest one if pairs differ")
        .property(
            "touch_source", [](const Report& self) { return to_string(self.report.touch_source); },
            "'option', 'precision', 'rounding' or 'none'")
        .property(
            "touch_file", [](const Report& self) { return self.report.touch_file; },
            "the model whose precision or rounding gives the tolerance");
}

void bind_results(py::module_& module) {
    bind_listed_clashes(module);
    bind_model_summary(module);
    const auto counts = [](const Report& self) { return to_dict(self.report.counts, kClashKinds); };
    const auto left_out = [](const Report& self) {
        return to_dict(self.report.left_out, kLeftOut);
    };
    const auto neighbours = [](const Report& self) {
        return to_dict(self.report.neighbours, kNeighbours);
    };
    const auto statuses = [](const Report& self) -> py::object {
        if (!self.report.statuses)
            return py::none();
        return to_dict(*self.report.statuses, kClashStatuses);
    };
    bind_matrix_of_report(module);
    PlainBinder<Report> binder(module, "ClashReport",
                               "Returned by find_clashes. Its length is the number of clashes.");
    bind_memory_and_groups_of_report(binder);
    bind_touch_of_report(binder);
    binder.property("clashes", &named_clashes, "list of Clash, in the order that `sort` asks for")
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
            "candidates", [](const Report& self) { return self.report.candidates; },
            "pairs of parts whose boxes are near")
        .property(
            "surfaces", [](const Report& self) { return self.report.surfaces; },
            "Surfaces: the parts that bound no solid, and so contain nothing")
        .property("left_out", left_out, "dict of LeftOut to number of pairs")
        .property("neighbours", neighbours, "dict of Neighbours to number of clashes")
        .property(
            "matrix", [](const Report& self) { return self.report.matrix; },
            "Matrix: the clashes cell by cell; None without a matrix")
        .property("statuses", statuses, "dict of status to number, of a store; else None")
        .property(
            "counters", [](const Report& self) { return self.counters; },
            "OutOfCoreCounters, of a store; else None")
        .property("seconds", seconds_of, "dict of stage to seconds")
        .property(
            "peak_rss_mib", [](const Report& self) { return self.report.peak_rss_mib; }, "MiB")
        .done()
        .def("__len__", [](const Report& self) { return self.report.clashes.size(); });
    bind_report_writers(module);
    module.def(
        "ranked_clashes", [](const Report& report) { return abut::ranked_clashes(report.report); },
        py::arg("report"),
        "Indices of a ClashReport's clashes, the worst first: hard ones by volume, then by depth.");
}

} // namespace

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
    bind_enum<Neighbours>(module, "Neighbours", {"fills", "connected", "covers", "same_assembly"},
                          "How two parts belong together (docs/selecting.md).");
    bind_enum<LeftOut>(module, "LeftOut",
                       {"not_selected", "ignored", "off", "fills", "connected", "covers",
                        "same_assembly", "tolerated", "other_kind"},
                       "Why a pair is not in a report.");
    bind_enum<ClashOrder>(module, "ClashOrder", {"part", "volume"}, "The order of clashes.");
    bind_rules(module);
    bind_results(module);
    add_verb(
        module, "find_clashes",
        "find_clashes(models, *, clearance=0, touch_tolerance=None, self=False, rules=[], "
        "progress=None,\n"
        "             only='', a='', b='', matrix=None, leave_out=[], sort='part')\n"
        "find_clashes(store, *, clearance=0, touch_tolerance=None, self=False, rules=[], "
        "progress=None,\n"
        "             memory=512 MiB, order='partition', keep=True, keep_hierarchies=True, "
        "crew=None,\n"
        "             only='', a='', b='', matrix=None, leave_out=[], sort='part')\n\n"
        "All clashes and clearances between the parts of different models; of one model, between "
        "its parts.\n\n"
        "models            list of Scene or paths, or one of them\n"
        "store             an open Store: models of any size in little memory\n"
        "clearance         metres; pairs without contact that are nearer are reported\n"
        "touch_tolerance   metres; surfaces that meet no deeper than this are of kind touch; "
        "None: what the files tell apart\n"
        "self              also the pairs within each model\n"
        "rules             list of ClashRule, or the path of a JSON or TOML file\n"
        "progress          function of (stage, fraction)\n"
        "memory            bytes for geometry, hierarchies and tables\n"
        "order             a WorkOrder\n"
        "keep              whether what is done is kept in the store, if that can be written to\n"
        "keep_hierarchies  whether hierarchies are kept with it\n"
        "crew              a Crew: the processes that do the job together, this one as their "
        "leader\n"
        "only              a condition, as text or PartQuery: both parts match it\n"
        "a, b              conditions: one part matches a, the other one b\n"
        "matrix            a ClashMatrix, the path of its file, or the name of a preset\n"
        "leave_out         list of Neighbours that are not tested\n"
        "sort              a ClashOrder: the order of the clashes\n\n"
        "Returns a ClashReport. Raises Error: bad_argument for a negative length, those of "
        "read_scene and of the store;\n"
        "KeyboardInterrupt at Ctrl-C.");
}

/// After the overload for stores, which is asked first.
void bind_clash_of_scenes() {
    add_overload("find_clashes", {anything,
                                  {"models * clearance touch_tolerance self rules progress "
                                   "only a b matrix leave_out sort",
                                   1},
                                  run_find_clashes});
}

} // namespace abut::python
