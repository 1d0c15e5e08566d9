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
    py::class_<ClashTopic>(module, "ClashTopic", "A topic and the clashes that it is about.")
        .def(py::init([](BcfTopic topic, std::vector<std::uint32_t> clashes) {
                 return ClashTopic{std::move(topic), std::move(clashes)};
             }),
             py::arg("topic"), py::arg("clashes"))
        .def_property(
            "topic", [](const ClashTopic& self) -> BcfTopic { return self.topic; },
            [](ClashTopic& self, const BcfTopic& topic) { self.topic = topic; }, "BcfTopic")
        .def_readwrite("clashes", &ClashTopic::clashes, "indices in ClashReport.clashes");
    module.def(
        "clash_bcf",
        [](const Report& report, const py::object& models, std::vector<ClashTopic> topics,
           std::string author, std::int64_t time, std::string project, bool clip,
           const py::object& snapshot, const py::object& progress) {
            ClashBcfOptions options;
            options.topics = std::move(topics);
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
        py::arg("report"), py::arg("models"), py::kw_only(),
        py::arg("topics") = std::vector<ClashTopic>{}, py::arg("author") = "Abut",
        py::arg("time") = std::int64_t{0}, py::arg("project") = "", py::arg("clip") = true,
        py::arg("snapshot") = py::none(), py::arg("progress") = py::none(),
        "The clashes of a report as topics of BCF, with viewpoints in metres, z up.\n\n"
        "models    what the report is about: list of Scene or paths, or a Store\n"
        "topics    list of ClashTopic; if empty, one for each clash\n"
        "author    who creates the topics\n"
        "time      when, in seconds since 1970; 0: now\n"
        "project   name of the project\n"
        "clip      whether planes cut away what lies outside of section boxes\n"
        "snapshot  function of a ClashViewpoint that returns the bytes of a PNG file\n\n"
        "Returns a BcfFile. Raises Error: bad_argument, those of the store.");
    module.def("update_bcf", &update_bcf, py::arg("earlier"), py::arg("later"),
               "Updates a BcfFile by a later export; what people have changed in it stays.");
}

} // namespace abut::python
