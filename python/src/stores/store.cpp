#include <abut/store.h>

#include "models/scenes.h"
#include "module.h"
#include "stores/open_store.h"
#include "support/records.h"
#include "support/work.h"

namespace abut::python {

namespace {

ImportReport import_into(const py::object& files, const py::object& store, std::uint64_t memory,
                         double unit, UpAxis up, bool spaces, bool map, bool outside,
                         const py::object& report) {
    ImportOptions options;
    options.memory = memory;
    options.unit = unit;
    options.up = up;
    options.spaces = spaces;
    options.map = map;
    options.allow_outside_files = outside;
    const auto paths = to_model_paths(files);
    const auto target = to_path(store);
    Work work(report);
    return work.run([&](const Progress& progress) {
        options.progress = progress;
        return import_models(paths, target, options);
    });
}

void bind_summary(py::module_& module) {
    PlainBinder<StoreSummary::Model>(module, "StoredModel", "A model of a StoreSummary.")
        .field("file", &StoreSummary::Model::file, "")
        .field("complete", &StoreSummary::Model::complete, "False: its import has not ended")
        .field("parts", &StoreSummary::Model::parts, "")
        .field("triangles", &StoreSummary::Model::triangles, "each instance counted")
        .field("generation", &StoreSummary::Model::generation, "")
        .field("unit", &StoreSummary::Model::unit, "metres per unit of the file")
        .field("up", &StoreSummary::Model::up, "UpAxis of the file")
        .field("notes", &StoreSummary::Model::notes, "list of SceneNote")
        .field("project", &StoreSummary::Model::project, "as Scene.project")
        .field("map_from_project", &StoreSummary::Model::map_from_project,
               "as Scene.map_from_project")
        .done();
    PlainBinder<StoreSummary::Property>(module, "StoredProperty",
                                        "A property that parts of a store have.")
        .field("name", &StoreSummary::Property::name, "")
        .field("parts", &StoreSummary::Property::parts, "that have it")
        .field("values", &StoreSummary::Property::values, "how many different ones")
        .done();
    PlainBinder<StoreSummary>(module, "StoreSummary", "Returned by summary.")
        .field("path", &StoreSummary::path, "")
        .field("version", &StoreSummary::version, "")
        .field("up", &StoreSummary::up, "UpAxis of the world")
        .field("complete", &StoreSummary::complete, "all models are")
        .field("generation", &StoreSummary::generation,
               "grows with each import that changes something")
        .field("models", &StoreSummary::models, "list of StoredModel")
        .field("parts", &StoreSummary::parts, "")
        .field("triangles", &StoreSummary::triangles, "each instance counted")
        .field("meshes", &StoreSummary::meshes, "")
        .field("stored_triangles", &StoreSummary::stored_triangles, "each mesh once")
        .field("blocks", &StoreSummary::blocks, "mesh blocks")
        .field("raw_bytes", &StoreSummary::raw_bytes, "of coordinates and indices")
        .field("stored_bytes", &StoreSummary::stored_bytes, "of the compressed blocks")
        .field("hierarchies", &StoreSummary::hierarchies, "that jobs have kept")
        .field("hierarchy_bytes", &StoreSummary::hierarchy_bytes, "")
        .field("levels", &StoreSummary::levels, "whether there are levels of detail")
        .field("level_chunks", &StoreSummary::level_chunks, "")
        .field("level_bytes", &StoreSummary::level_bytes, "stored")
        .field("file_bytes", &StoreSummary::file_bytes, "")
        .field("unused_bytes", &StoreSummary::unused_bytes, "of the file")
        .field("bounds", &StoreSummary::bounds, "Box3 of all parts in the world")
        .field("properties", &StoreSummary::properties, "list of StoredProperty")
        .field("relations", &StoreSummary::relations, "how many; see PartRelation")
        .done();
}

void bind_reports(py::module_& module) {
    PlainBinder<ImportedModel>(module, "ImportedModel", "What an import did to one file.")
        .field("file", &ImportedModel::file, "as given")
        .field("outcome", &ImportedModel::outcome, "ImportOutcome")
        .field("streamed", &ImportedModel::streamed,
               "by a reader that does not load the file whole")
        .field("bytes", &ImportedModel::bytes, "")
        .field("parts", &ImportedModel::parts, "")
        .field("triangles", &ImportedModel::triangles, "each instance counted")
        .field("added", &ImportedModel::added, "parts")
        .field("changed", &ImportedModel::changed, "parts")
        .field("removed", &ImportedModel::removed, "parts")
        .field("seconds", &ImportedModel::seconds, "")
        .field("unit", &ImportedModel::unit, "metres per unit of the file")
        .field("up", &ImportedModel::up, "UpAxis of the file")
        .field("notes", &ImportedModel::notes, "list of SceneNote")
        .done();
    PlainBinder<ImportReport>(module, "ImportReport", "Returned by import_models.")
        .field("models", &ImportReport::models, "list of ImportedModel")
        .field("new_meshes", &ImportReport::new_meshes, "stored; the others were there already")
        .field("removed_meshes", &ImportReport::removed_meshes, "that no part uses any more")
        .field("seconds", &ImportReport::seconds, "")
        .done();
    PlainBinder<RemovedModel>(module, "RemovedModel", "A model that was taken out of a store.")
        .field("file", &RemovedModel::file, "")
        .field("parts", &RemovedModel::parts, "")
        .done();
    PlainBinder<RemovalReport>(module, "RemovalReport", "Returned by remove_models.")
        .field("models", &RemovalReport::models, "list of RemovedModel")
        .field("removed_meshes", &RemovalReport::removed_meshes, "that no part uses any more")
        .done();
    bind_summary(module);
}

void bind_store_class(py::module_& module) {
    py::class_<OpenStore>(module, "Store",
                          "An open store, made by open_store. A context manager: leaving it closes "
                          "the store, and every use\n"
                          "of a closed store raises ValueError.")
        .def(
            "close", [](OpenStore& self) { self.store.reset(); },
            "Closes the store; a walk through it keeps the file open.")
        .def_property_readonly("closed", [](const OpenStore& self) { return !self.store; })
        .def_readonly("path", &OpenStore::path)
        .def("__enter__", [](const py::object& self) { return self; })
        .def("__exit__", [](OpenStore& self, const py::args& /*error*/) { self.store.reset(); })
        .def("__repr__", [](const OpenStore& self) {
            return "<abut.Store: " + self.path + (self.store ? ">" : ", closed>");
        });
}

void bind_imports(py::module_& module) {
    module.def(
        "import_models", &import_into, py::arg("files"), py::arg("store"), py::kw_only(),
        py::arg("memory") = std::uint64_t{512} << 20, py::arg("unit") = 0.0, py::arg("up") = "z",
        py::arg("spaces") = false, py::arg("map") = true, py::arg("allow_outside_files") = false,
        py::arg("progress") = py::none(),
        "import_models(files, store, *, memory=512 MiB, unit=0, up='z', spaces=False, map=True,\n"
        "              allow_outside_files=False, progress=None)\n\n"
        "Brings model files into a store, one SQLite file, which is made if it is not there. A "
        "file that has not\n"
        "changed costs nothing.\n\n"
        "files   list of paths, with units and axes as read_scene takes them\n"
        "store   path of the store\n"
        "memory  bytes that the import may keep in memory, at least 16 MiB\n"
        "Others as read_scene.\n\n"
        "Returns an ImportReport. Raises Error as read_scene and open_store; after one, and after "
        "Ctrl-C, the store\n"
        "holds each model as it was before or as it is now.");
    module.def(
        "remove_models",
        [](const py::object& files, const py::object& store) {
            std::vector<std::string> list;
            for (const py::handle file : files)
                list.push_back(to_path(file));
            return remove_models(list, to_path(store));
        },
        py::arg("files"), py::arg("store"),
        "Takes models out of a store, all of them or none. Returns a RemovalReport. Raises Error "
        "(bad_argument) if a file\n"
        "is no model of the store.");
}

} // namespace

void bind_store(py::module_& module) {
    bind_enum<ImportOutcome>(module, "ImportOutcome", {"added", "changed", "unchanged"},
                             "What an import did to one file.");
    bind_reports(module);
    bind_store_class(module);
    bind_imports(module);
    module.def(
        "open_store",
        [](const py::object& path, bool read_only) {
            const auto text = to_path(path);
            return OpenStore{text, open_store(text, {.read_only = read_only})};
        },
        py::arg("path"), py::kw_only(), py::arg("read_only") = true,
        "Opens a Store. Raises Error: file_not_found, malformed, unsupported (a newer version's), "
        "unreadable (another\n"
        "process writes it).");
    module.def(
        "is_store", [](const py::object& path) { return is_store(to_path(path)); }, py::arg("path"),
        "Whether a file begins as a store does.");
    module.def(
        "summary", [](const OpenStore& store) { return summary(store.get()); }, py::arg("store"),
        "A StoreSummary. Raises Error (malformed) if the store is damaged.");
    module.def(
        "read_parts",
        [](const OpenStore& store, std::size_t model) { return read_parts(store.get(), model); },
        py::arg("store"), py::arg("model") = 0,
        "The parts of a model of a store as a Scene without meshes, with their properties and "
        "relations. model is an index in\n"
        "StoreSummary.models. Raises Error: bad_argument, malformed.");
    module.def(
        "verify",
        [](const OpenStore& store, const py::object& report) {
            const Store open = store.get();
            Work work(report);
            work.run([&](const Progress& progress) { verify(open, progress); });
        },
        py::arg("store"), py::kw_only(), py::arg("progress") = py::none(),
        "Reads all of a store and checks it against its checksums. Raises Error (malformed).");
}

} // namespace abut::python
