#include <abut/clash_viewpoint.h>

#include "models/scenes.h"
#include "module.h"
#include "stores/clashes.h"
#include "stores/open_store.h"
#include "support/records.h"
#include "support/work.h"

namespace abut::python {

namespace {

using ClashLists = std::vector<std::vector<std::uint32_t>>;

std::vector<ClashViewpoint> run_viewpoints(const Report& report, const py::object& models,
                                           const ClashLists& clashes, double fov, double aspect,
                                           bool near, const py::object& progress) {
    ViewpointOptions options{fov, aspect, near, {}};
    if (py::isinstance<OpenStore>(models)) {
        const Store store = models.cast<const OpenStore&>().get();
        const StoreClashReport found{report.report, *report.models, {}};
        Work work(progress);
        return work.run([&](const Progress& reported) {
            options.progress = reported;
            return clash_viewpoints(found, store, clashes, options);
        });
    }
    const std::vector<Scene> scenes = to_scenes(models, progress);
    Work work(progress);
    return work.run([&](const Progress& reported) {
        options.progress = reported;
        return clash_viewpoints(report.report, scenes, clashes, options);
    });
}

void bind_viewpoint_records(py::module_& module) {
    PlainBinder<ReportPart>(module, "ReportPart", "A part by the indices that clashes use.")
        .field("model", &ReportPart::model, "")
        .field("part", &ReportPart::part, "")
        .done();
    PlainBinder<NamedPart>(module, "NamedPart", "NamedPart(file, id)\n\nA part by its words.")
        .field("file", &NamedPart::file, "")
        .field("id", &NamedPart::id, "")
        .done()
        .def(py::init([](const std::string& file, const std::string& id) {
                 return NamedPart{file, id};
             }),
             py::arg("file"), py::arg("id"))
        .def("__eq__", [](const NamedPart& a, const NamedPart& b) { return a == b; });
    PlainBinder<ClashViewpoint>(module, "ClashViewpoint",
                                "A camera that shows one clash or several. Lengths in metres.")
        .field("eye", &ClashViewpoint::eye, "")
        .field("direction", &ClashViewpoint::direction, "unit vector")
        .field("up", &ClashViewpoint::up, "unit vector")
        .field("fov", &ClashViewpoint::fov, "vertical angle in radians")
        .field("aspect", &ClashViewpoint::aspect, "width of the picture, divided by its height")
        .field("section_box", &ClashViewpoint::section_box, "Box3; what lies outside may be hidden")
        .field("shown_a", &ClashViewpoint::shown_a, "fraction of the picture that side a covers")
        .field("shown_b", &ClashViewpoint::shown_b, "fraction of the picture that side b covers")
        .field("side_a", &ClashViewpoint::side_a, "list of ReportPart")
        .field("side_b", &ClashViewpoint::side_b, "list of ReportPart")
        .field("near", &ClashViewpoint::near, "list of NamedPart: others in the section box")
        .done();
}

} // namespace

void bind_clash_viewpoint(py::module_& module) {
    bind_viewpoint_records(module);
    const ViewpointOptions usual;
    module.def("clash_viewpoints", &run_viewpoints, py::arg("report"), py::arg("models"),
               py::arg("clashes"), py::kw_only(), py::arg("fov") = usual.fov,
               py::arg("aspect") = usual.aspect, py::arg("near") = usual.near,
               py::arg("progress") = py::none(),
               "The best viewpoint of each list of clashes, by their indices in the report.\n\n"
               "models   what the report is about: list of Scene or paths, or a Store\n"
               "fov      vertical angle in radians\n"
               "aspect   of the picture: width / height\n"
               "near     whether the other parts in the section boxes are listed\n\n"
               "Returns a list of ClashViewpoint. Raises Error: bad_argument, those of the store.");
    module.def(
        "clash_viewpoint",
        [](const Report& report, const py::object& models, std::uint32_t clash, double fov,
           double aspect, bool near) {
            return run_viewpoints(report, models, {{clash}}, fov, aspect, near, py::none()).front();
        },
        py::arg("report"), py::arg("models"), py::arg("clash"), py::kw_only(),
        py::arg("fov") = usual.fov, py::arg("aspect") = usual.aspect, py::arg("near") = usual.near,
        "As clash_viewpoints, for one clash.");
    module.def(
        "clash_viewpoint",
        [](const OpenStore& models, const ListedClash& clash, double fov, double aspect, bool near,
           const py::object& progress) {
            const Store store = models.get();
            ViewpointOptions options{fov, aspect, near, {}};
            Work work(progress);
            return work.run([&](const Progress& reported) {
                options.progress = reported;
                return clash_viewpoint(store, clash, options);
            });
        },
        py::arg("store"), py::arg("clash"), py::kw_only(), py::arg("fov") = usual.fov,
        py::arg("aspect") = usual.aspect, py::arg("near") = usual.near,
        py::arg("progress") = py::none(),
        "The best viewpoint of a clash as review_clashes lists it.\n\nRaises Error: bad_argument "
        "if "
        "the store lacks a part of the clash, those of the store.");
}

} // namespace abut::python
