#include <abut/model_contacts.h>

#include "module.h"
#include "queries/queries.h"

namespace abut::python {

namespace {

std::vector<ModelManifold>
run_contact_manifolds(const Model& a, const py::object& pose_a, const Model& b,
                      const py::object& pose_b, double margin,
                      const std::optional<std::vector<ModelManifold>>& last,
                      const py::object& progress) {
    const Transform world_from_a = to_transform(pose_a, "pose_a"),
                    world_from_b = to_transform(pose_b, "pose_b");
    ManifoldOptions options;
    options.margin = margin;
    options.last = last ? &*last : nullptr;
    Work work(progress);
    return work.run([&](const Progress& own) {
        options.progress = own;
        return contact_manifolds(a, world_from_a, b, world_from_b, options);
    });
}

} // namespace

void bind_model_contacts(py::module_& module) {
    PlainBinder<ModelManifold>(module, "ModelManifold",
                               "A region where two models meet, as a contact solver needs it.")
        .field("normal", &ModelManifold::normal, "unit vector from a to b")
        .field("region", &ModelManifold::region, "names the region")
        .field("count", &ModelManifold::count, "of the points, 1 to 4")
        .property(
            "points",
            [](const ModelManifold& m) {
                return records(
                    std::vector<ContactPoint>(m.points.begin(), m.points.begin() + m.count));
            },
            "record array of ContactPoint: the deepest comes first")
        .field("status", &ModelManifold::status, "Status")
        .done();
    module.def("contact_manifolds", &run_contact_manifolds, py::arg("a"), py::arg("pose_a"),
               py::arg("b"), py::arg("pose_b"), py::kw_only(), py::arg("margin") = 0.0,
               py::arg("last") = py::none(), py::arg("progress") = py::none(),
               "contact_manifolds(a, pose_a, b, pose_b, *, margin=0, last=None, progress=None)\n\n"
               "A normal and up to four points for each region where two Model touch.\n\n"
               "margin    triangles that are at most this far apart give points with negative "
               "depth\n"
               "last      the list of the last step: regions keep its names\n"
               "progress  function of (stage, fraction)\n\n"
               "Returns a list of ModelManifold. Raises Error (bad_argument) if a pose or the "
               "margin is not finite,\n"
               "or the margin is negative; KeyboardInterrupt at Ctrl-C.");
}

} // namespace abut::python
