#include <abut/maintenance_path.h>

#include "module.h"
#include "walks/open_walk.h"

namespace abut::python {

namespace {

PathReport check(OpenWalk& self, const py::object& probe, const py::object& poses,
                 PathOptions options, const py::object& report) {
    const auto list = to_pose_list(poses, "poses");
    if (PyLong_Check(probe.ptr())) {
        const WalkPart part{probe.cast<std::int64_t>()};
        return self.query(
            [&](Walk& walk, const Progress& progress) {
                options.progress = progress;
                return check_path(walk, part, list, options);
            },
            report);
    }
    const Probe shape = to_probe(probe);
    return self.query(
        [&](Walk& walk, const Progress& progress) {
            options.progress = progress;
            return check_path(walk, shape, list, options);
        },
        report);
}

void bind_path_results(py::module_& module) {
    PlainBinder<PathContact>(module, "PathContact", "A part that is met on a path.")
        .field("time", &PathContact::time, "in poses: 3.25 is a quarter of the way from 3 to 4")
        .field("impact", &PathContact::impact, "PartImpact between the two poses")
        .done();
    PlainBinder<PathClearance>(module, "PathClearance", "The least distance along a path.")
        .field("found", &PathClearance::found, "else no part is nearer than the largest clearance")
        .field("distance", &PathClearance::distance, "length, attained at `time`")
        .field("at_least", &PathClearance::at_least, "length: a proven lower bound")
        .field("time", &PathClearance::time, "in poses")
        .property(
            "part", [](const PathClearance& self) { return self.part.number; },
            "number of the part")
        .field("point_part", &PathClearance::point_part, "array of shape (3,), world frame")
        .field("point_probe", &PathClearance::point_probe, "array of shape (3,), world frame")
        .done();
    PlainBinder<PathReport>(module, "PathReport",
                            "Returned by check_path. True if the path is free.")
        .property(
            "is_free", [](const PathReport& self) { return self.is_free(); }, "no part is met")
        .field("poses", &PathReport::poses, "number of poses")
        .field("length", &PathReport::length, "of the way")
        .property(
            "touched_at_start",
            [](const PathReport& self) { return part_numbers(self.touched_at_start); },
            "int64 array of shape (n,): parts that the probe touches at the first pose")
        .field("contacts", &PathReport::contacts, "list of PathContact, sorted by time")
        .field("clearance", &PathReport::clearance, "PathClearance")
        .done()
        .def("__bool__", [](const PathReport& self) { return self.is_free(); });
    module.def(
        "to_json",
        [](const PathReport& report, OpenWalk& walk) {
            return walk.run([&](Walk& open) { return to_json(report, open); });
        },
        py::arg("report"), py::arg("walk"));
}

} // namespace

void bind_maintenance_path(py::module_& module) {
    PlainBinder<CarriedPart>(module, "CarriedPart",
                             "A part as it is carried: its model has the world's axes.")
        .field("model", &CarriedPart::model, "Model")
        .field("pose", &CarriedPart::pose, "Pose: where the part is now")
        .field("linear", &CarriedPart::linear, "matrix of shape (4, 4): rotation and scale")
        .done()
        .def(
            "world_from_part",
            [](const CarriedPart& self, const py::object& at) {
                return self.world_from_part(to_pose(at, "pose"));
            },
            py::arg("pose"), "Where a pose puts the part, as Walk.move takes it.");
    module.def(
        "carried_part",
        [](OpenWalk& walk, std::int64_t part) {
            return walk.run([&](Walk& open) { return carried_part(open, {part}); });
        },
        py::arg("walk"), py::arg("part"), "The CarriedPart of a part. Errors as Walk.model.");
    bind_path_results(module);
    module.def(
        "check_path",
        [](OpenWalk& walk, const py::object& probe, const py::object& poses,
           std::int64_t except_part, double largest_clearance, double clearance_error,
           std::uint64_t max_queries, std::optional<double> absolute_error,
           const py::object& report) {
            return check(walk, probe, poses,
                         {{except_part},
                          largest_clearance,
                          clearance_error,
                          max_queries,
                          absolute_error,
                          {}},
                         report);
        },
        py::arg("walk"), py::arg("probe"), py::arg("poses"), py::kw_only(),
        py::arg("except_part") = 0, py::arg("largest_clearance") = 1.0,
        py::arg("clearance_error") = 1e-3, py::arg("max_queries") = 20'000,
        py::arg("absolute_error") = py::none(), py::arg("progress") = py::none(),
        "Whether a part can be carried along poses: which parts are met, and how near others "
        "are.\n\n"
        "walk               a Walk\n"
        "probe              a Probe or what one is made of; or the number of a part of the walk\n"
        "poses              array of shape (n, 4, 4), or a list of poses, all rigid\n"
        "except_part        number of a part that is not in the way; 0: none\n"
        "largest_clearance  length; clearances above it are not measured\n"
        "clearance_error    length by which the clearance may exceed the least one\n"
        "max_queries        limit of the search for the clearance\n"
        "absolute_error     length, of contacts, as for time_of_impact\n"
        "progress           function of (stage, fraction)\n\n"
        "Returns a PathReport. Raises Error (bad_argument); KeyboardInterrupt at Ctrl-C.");
}

} // namespace abut::python
