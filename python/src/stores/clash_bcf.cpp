#include <abut/clash_bcf.h>

#include "models/scenes.h"
#include "module.h"
#include "stores/clashes.h"
#include "stores/open_store.h"
#include "support/records.h"
#include "support/work.h"

namespace abut::python {

namespace {

BcfFile run_clash_bcf(const Report& report, const py::object& models, ClashBcfOptions options,
                      const py::object& progress) {
    if (py::isinstance<OpenStore>(models)) {
        const Store store = models.cast<const OpenStore&>().get();
        const StoreClashReport found{report.report, *report.models, {}};
        Work work(progress);
        return work.run([&](const Progress& reported) {
            options.progress = reported;
            return clash_bcf(found, store, options);
        });
    }
    const std::vector<Scene> scenes = to_scenes(models, progress);
    Work work(progress);
    return work.run([&](const Progress& reported) {
        options.progress = reported;
        return clash_bcf(report.report, scenes, options);
    });
}

} // namespace

void bind_clash_bcf(py::module_& module) {
    module.def(
        "clash_bcf",
        [](const Report& report, const py::object& models, std::string author, std::int64_t time,
           std::string project, bool clip, const py::object& snapshot, const py::object& progress) {
            ClashBcfOptions options;
            options.author = std::move(author);
            options.time = time;
            options.project = std::move(project);
            options.clip = clip;
            if (!snapshot.is_none())
                options.snapshot = [&snapshot](const ClashViewpoint& view) {
                    const py::gil_scoped_acquire lock;
                    return std::string(snapshot(view).cast<py::bytes>());
                };
            return run_clash_bcf(report, models, std::move(options), progress);
        },
        py::arg("report"), py::arg("models"), py::kw_only(), py::arg("author") = "Abut",
        py::arg("time") = std::int64_t{0}, py::arg("project") = "", py::arg("clip") = true,
        py::arg("snapshot") = py::none(), py::arg("progress") = py::none(),
        "The groups of a report as topics of BCF, with viewpoints in metres, z up. Without groups, "
        "each clash is a topic.\n\n"
        "models    what the report is about: list of Scene or paths, or a Store\n"
        "author    who creates the topics\n"
        "time      when, in seconds since 1970; 0: now\n"
        "project   name of the project\n"
        "clip      whether planes cut away what lies outside of section boxes\n"
        "snapshot  function of a ClashViewpoint that returns the bytes of a PNG file\n\n"
        "Returns a BcfFile. Raises Error: bad_argument, those of the store.");
    module.def("update_bcf", &update_bcf, py::arg("earlier"), py::arg("later"),
               "Updates a BcfFile by a later export; what people have changed in it stays.");
    module.def("bcf_revision", &bcf_revision, py::arg("file"),
               "The revision of a store's topics that a BcfFile was exported from, or None.");
    module.def(
        "merge_bcf",
        [](const OpenStore& store, const BcfFile& file, std::optional<std::int64_t> base,
           std::string author, std::int64_t now) {
            return merge_bcf(store.get(), file, {base, std::move(author), now});
        },
        py::arg("store"), py::arg("file"), py::kw_only(), py::arg("base") = py::none(),
        py::arg("author") = "", py::arg("now") = 0,
        "Merges the topics of a BcfFile into a store.\n\n"
        "base    revision that the file was exported from; None: what the file says\n"
        "author  who made the changes; empty: whom the file names\n"
        "now     the time of the change, in seconds since 1970; 0: the clock\n\n"
        "Returns a TopicMerge. Raises Error as merge_topics does.");
}

} // namespace abut::python
