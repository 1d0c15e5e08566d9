#include <abut/walk.h>

#include "module.h"
#include "walks/open_walk.h"

namespace abut::python {

namespace {

/// Asks about a probe at a pose, or about a part at its place: `ask(walk, query, what…)`.
template <class Ask>
auto ask_walk(OpenWalk& self, const py::object& shape, const py::object& pose, WalkQuery query,
              Ask ask) {
    if (PyLong_Check(shape.ptr())) {
        if (!pose.is_none())
            throw py::value_error("pose: a part of the walk has its place: None is wanted");
        const WalkPart part{shape.cast<std::int64_t>()};
        return self.query([&](Walk& walk, const Progress& progress) {
            query.progress = progress;
            return ask(walk, query, part);
        });
    }
    const Probe probe = to_probe(shape);
    const Transform place = to_transform(pose, "pose");
    return self.query([&](Walk& walk, const Progress& progress) {
        query.progress = progress;
        return ask(walk, query, probe, place);
    });
}

py::class_<OpenWalk> walk_class(py::module_& module) {
    return py::class_<OpenWalk>(
               module, "Walk",
               "Walk(store, *, memory=512 MiB, look_ahead=3, prefetch=True)\n\n"
               "A region of interest that moves through an open Store, and queries about "
               "what is there. Answers are\n"
               "those that all parts in memory would give. A part is an int. One thread at "
               "a time may use a walk. The\n"
               "walk keeps the store's file open.\n\n"
               "memory      bytes for tables, geometry and hierarchies\n"
               "look_ahead  seconds of the predicted path along which parts are read\n"
               "prefetch    whether a second thread reads ahead\n\n"
               "Raises Error as open_store; bad_argument if an import has not ended or the "
               "memory is too small.")
        .def(
            py::init([](const OpenStore& store, std::uint64_t memory, double look_ahead,
                        bool prefetch) {
                return std::make_unique<OpenWalk>(store, WalkOptions{memory, look_ahead, prefetch});
            }),
            py::arg("store"), py::kw_only(), py::arg("memory") = std::uint64_t{512} << 20,
            py::arg("look_ahead") = 3.0, py::arg("prefetch") = true)
        .def(
            "move_to",
            [](OpenWalk& self, const py::object& position, const py::object& velocity) {
                const Vec3 place = to_vec3(position, "position");
                if (velocity.is_none())
                    return self.run([&](Walk& walk) { walk.move_to(place); });
                const Vec3 speed = to_vec3(velocity, "velocity");
                self.run([&](Walk& walk) { walk.move_to(place, speed); });
            },
            py::arg("position"), py::arg("velocity") = py::none(),
            "Says where the region of interest is, and its velocity in units a second. Never waits "
            "for the disk.")
        .def(
            "wait", [](OpenWalk& self) { self.run([](Walk& walk) { walk.wait(); }); },
            "Waits until what is near and ahead is in memory, or memory is full.");
}

void add_walk_queries(py::class_<OpenWalk>& type) {
    const double infinity = std::numeric_limits<double>::infinity();
    type.def(
            "distance",
            [](OpenWalk& self, const py::object& probe, const py::object& pose, double upper_bound,
               MissingParts missing, std::int64_t except) {
                WalkQuery query = query_of(missing, except);
                query.upper_bound = upper_bound;
                return ask_walk(self, probe, pose, query,
                                [](Walk& walk, const WalkQuery& q, const auto&... what) {
                                    return walk.distance(what..., q);
                                });
            },
            py::arg("probe"), py::arg("pose") = py::none(), py::kw_only(),
            py::arg("upper_bound") = infinity, py::arg("missing") = "wait",
            py::arg("except_part") = 0,
            "The part nearest to the probe: a NearestPart.\n\n"
            "probe        a Probe, or what one is made of; or the number of a part, at its place\n"
            "pose         of the probe; None for a part\n"
            "upper_bound  length; parts farther away are ignored\n"
            "missing      MissingParts\n"
            "except_part  number of a part to leave out; 0: none\n\n"
            "Ctrl-C ends this query and those below.")
        .def(
            "within",
            [](OpenWalk& self, const py::object& probe, const py::object& pose, double tolerance,
               MissingParts missing, std::int64_t except) {
                return ask_walk(self, probe, pose, query_of(missing, except),
                                [=](Walk& walk, const WalkQuery& q, const auto&... what) {
                                    return walk.within(what..., tolerance, q);
                                });
            },
            py::arg("probe"), py::arg("pose"), py::arg("tolerance"), py::kw_only(),
            py::arg("missing") = "wait", py::arg("except_part") = 0,
            "All parts at most `tolerance` away, and how far: NearParts. Otherwise as distance.")
        .def(
            "collide",
            [](OpenWalk& self, const py::object& probe, const py::object& pose, ContactMode mode,
               MissingParts missing, std::int64_t except) {
                WalkQuery query = query_of(missing, except);
                query.mode = mode;
                return ask_walk(self, probe, pose, query,
                                [](Walk& walk, const WalkQuery& q, const auto&... what) {
                                    return walk.collide(what..., q);
                                });
            },
            py::arg("probe"), py::arg("pose") = py::none(), py::kw_only(), py::arg("mode") = "all",
            py::arg("missing") = "wait", py::arg("except_part") = 0,
            "The parts that share a point with the probe: TouchedParts. Otherwise as distance.");
}

void add_walk_ways(py::class_<OpenWalk>& type) {
    type.def(
            "penetration",
            [](OpenWalk& self, const py::object& probe, const py::object& pose,
               MissingParts missing, std::int64_t except, std::optional<std::uint64_t> max_steps) {
                WalkQuery query = query_of(missing, except);
                query.max_steps = max_steps;
                return ask_walk(self, probe, pose, query,
                                [](Walk& walk, const WalkQuery& q, const auto&... what) {
                                    return walk.penetration(what..., q);
                                });
            },
            py::arg("probe"), py::arg("pose") = py::none(), py::kw_only(),
            py::arg("missing") = "wait", py::arg("except_part") = 0,
            py::arg("max_steps") = py::none(),
            "The parts that share a point with the probe, and how deep they go into each other:\n"
            "NearParts. max_steps: most steps of all depths together; a depth that needs more is\n"
            "bound_only. Otherwise as distance.")
        .def(
            "first_hit",
            [](OpenWalk& self, const py::object& origin, const py::object& direction, double t_min,
               double t_max, MissingParts missing, std::int64_t except) {
                const Ray ray = to_ray(origin, direction, t_min, t_max);
                WalkQuery query = query_of(missing, except);
                return self.query([&](Walk& walk, const Progress& progress) {
                    query.progress = progress;
                    return walk.first_hit(ray, query);
                });
            },
            py::arg("origin"), py::arg("direction") = py::none(), py::arg("t_min") = 0.0,
            py::arg("t_max") = std::numeric_limits<double>::infinity(), py::kw_only(),
            py::arg("missing") = "wait", py::arg("except_part") = 0,
            "The first part that a ray meets: a HitPart.\n\n"
            "origin     a Ray, or its origin, shape (3,)\n"
            "direction  array of shape (3,), if the origin is no Ray")
        .def(
            "sweep",
            [](OpenWalk& self, const py::object& shape, const py::object& pose,
               const py::object& translation, MissingParts missing, std::int64_t except,
               std::optional<double> absolute_error) {
                const Probe probe = to_probe(shape);
                const Transform place = to_transform(pose, "pose");
                const Vec3 way = to_vec3(translation, "translation");
                WalkQuery query = query_of(missing, except);
                query.absolute_error = absolute_error;
                return self.query([&](Walk& walk, const Progress& progress) {
                    query.progress = progress;
                    return walk.sweep(probe, place, way, query);
                });
            },
            py::arg("probe"), py::arg("pose"), py::arg("translation"), py::kw_only(),
            py::arg("missing") = "wait", py::arg("except_part") = 0,
            py::arg("absolute_error") = py::none(),
            "The first contact of a probe that moves in a straight line by `translation` while "
            "the\n"
            "time goes from 0 to 1: a FirstContact. None is missed, however far it moves.\n\n"
            "absolute_error  length, as for time_of_impact");
}

void add_walk_motions(py::class_<OpenWalk>& type) {
    type.def(
            "time_of_impact",
            [](OpenWalk& self, const py::object& shape, const Motion& motion, MissingParts missing,
               std::int64_t except, std::optional<double> absolute_error) {
                const Probe probe = to_probe(shape);
                WalkQuery query = query_of(missing, except);
                query.absolute_error = absolute_error;
                return self.query([&](Walk& walk, const Progress& progress) {
                    query.progress = progress;
                    return walk.time_of_impact(probe, motion, query);
                });
            },
            py::arg("probe"), py::arg("motion"), py::kw_only(), py::arg("missing") = "wait",
            py::arg("except_part") = 0, py::arg("absolute_error") = py::none(),
            "The first contact of a probe that moves and turns: a FirstContact.")
        .def(
            "parts_in_way",
            [](OpenWalk& self, const py::object& shape, const Motion& motion, MissingParts missing,
               std::int64_t except, std::optional<double> absolute_error) {
                const Probe probe = to_probe(shape);
                WalkQuery query = query_of(missing, except);
                query.absolute_error = absolute_error;
                return self.query([&](Walk& walk, const Progress& progress) {
                    query.progress = progress;
                    return walk.parts_in_way(probe, motion, query);
                });
            },
            py::arg("probe"), py::arg("motion"), py::kw_only(), py::arg("missing") = "wait",
            py::arg("except_part") = 0, py::arg("absolute_error") = py::none(),
            "All parts that a moving probe meets, each with its own time: PartsInWay.");
}

void add_walk_parts(py::class_<OpenWalk>& type) {
    type.def(
            "add",
            [](OpenWalk& self, const Model& model, const py::object& pose) {
                const Transform place = to_transform(pose, "pose");
                return self.run([&](Walk& walk) { return walk.add(model, place); }).number;
            },
            py::arg("model"), py::arg("pose"),
            "Brings in a part that is not in the store; returns its number.")
        .def(
            "move",
            [](OpenWalk& self, std::int64_t part, const py::object& pose) {
                const Transform place = to_transform(pose, "pose");
                self.run([&](Walk& walk) { walk.move({part}, place); });
            },
            py::arg("part"), py::arg("pose"),
            "Puts a part elsewhere, for this walk. Error (bad_argument) if there is no such part.")
        .def(
            "remove",
            [](OpenWalk& self, std::int64_t part) {
                self.run([&](Walk& walk) { walk.remove({part}); });
            },
            py::arg("part"), "Takes a part out, for this walk.")
        .def(
            "name",
            [](OpenWalk& self, std::int64_t part) {
                return self.run([&](Walk& walk) { return walk.name({part}); });
            },
            py::arg("part"), "A WalkPartName.")
        .def(
            "world_from_part",
            [](OpenWalk& self, std::int64_t part) {
                return self.run([&](Walk& walk) { return walk.world_from_part({part}); });
            },
            py::arg("part"), "The part's pose, a matrix of shape (4, 4).")
        .def(
            "model",
            [](OpenWalk& self, std::int64_t part) {
                return self.run([&](Walk& walk) { return walk.model({part}); });
            },
            py::arg("part"), "The part's Model.")
        .def_property_readonly("statistics", [](OpenWalk& self) {
            return self.run([](Walk& walk) { return walk.statistics(); });
        });
}

} // namespace

Probe to_probe(const py::object& shape) {
    if (const auto* probe = peek<Probe>(shape))
        return *probe;
    if (const auto* model = peek<Model>(shape))
        return Probe(*model);
    if (const auto* convex = peek<Convex>(shape))
        return Probe(*convex);
    if (const auto* sphere = peek<Sphere>(shape))
        return Probe(*sphere);
    if (const auto* capsule = peek<Capsule>(shape))
        return Probe(*capsule);
    if (const auto* box = peek<Box3>(shape))
        return Probe(*box);
    throw py::type_error("probe: a Probe, Model, Convex, Sphere, Capsule or Box3 is wanted");
}

void bind_walk(py::module_& module) {
    bind_enum<MissingParts>(module, "MissingParts", {"wait", "skip"},
                            "What a query does about parts that are not in memory.");
    bind_walk_results(module);
    py::class_<Probe>(module, "Probe",
                      "Probe(shape)\n\nA Model, Convex, Sphere, Capsule or Box3 that is moved "
                      "about in a walk. Make it once.")
        .def(py::init(&to_probe), py::arg("shape"));
    auto walk = walk_class(module);
    add_walk_queries(walk);
    add_walk_ways(walk);
    add_walk_motions(walk);
    add_walk_parts(walk);
}

} // namespace abut::python
