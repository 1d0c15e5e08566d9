#include <abut/walk.h>

#include "module.h"
#include "open_store.h"
#include "queries.h"

namespace abut::python {

/// Parts of a walk are their numbers.
template <>
struct FieldFormat<WalkPart> {
    static py::object make() { return py::dtype::of<std::int64_t>(); }
};
template <>
inline py::object to_python<WalkPart>(const WalkPart& part) {
    return py::int_(part.number);
}

namespace {

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

/// A walk, which one thread at a time uses.
class Walker {
public:
    Walker(const OpenStore& store, const WalkOptions& options)
        : walk_(make(store.get(), options)) {}

    template <class Use>
    auto run(Use use) {
        const InUse::Change change(use_, "the walk");
        const py::gil_scoped_release unlocked;
        return use(walk_);
    }

private:
    static Walk make(const Store& store, const WalkOptions& options) {
        const py::gil_scoped_release unlocked;
        return Walk(store, options);
    }
    Walk walk_;
    InUse use_;
};

WalkQuery query_of(MissingParts missing, std::int64_t except) {
    WalkQuery query;
    query.missing = missing;
    query.except = {except};
    return query;
}

py::array part_numbers(const std::vector<WalkPart>& parts) {
    std::vector<std::int64_t> list;
    list.reserve(parts.size());
    for (const WalkPart part : parts)
        list.push_back(part.number);
    return numbers(std::move(list));
}

template <class Answer>
PlainBinder<Answer>& add_answer(PlainBinder<Answer>& binder) {
    return binder
        .field("complete", &WalkAnswer::complete,
               "False if parts that may matter were not in memory and skipped")
        .field("candidates", &WalkAnswer::candidates, "parts whose boxes were in reach")
        .field("misses", &WalkAnswer::misses, "of these, those that were not in memory");
}

void bind_walk_results(py::module_& module) {
    RecordBinder<WalkGap>(module, "WalkGap",
                          "How a part and the probe lie to each other, world frame.")
        .field("part", &WalkGap::part, "number of the part")
        .field("distance", &WalkGap::distance, "length; 0 if they touch, negative: minus the depth")
        .field("point_part", &WalkGap::point_part, "on the part")
        .field("point_probe", &WalkGap::point_probe, "on the probe")
        .field("normal", &WalkGap::normal, "unit vector from the part to the probe")
        .field("triangle_part", &WalkGap::triangle_part, "of a mesh; else 0")
        .field("triangle_probe", &WalkGap::triangle_probe, "of a mesh; else 0")
        .field("status", &WalkGap::status, "Status")
        .done();
    PlainBinder<NearestPart> nearest(module, "NearestPart", "Returned by Walk.distance.");
    nearest.field("found", &NearestPart::found, "else no part is nearer than the bound")
        .field("gap", &NearestPart::gap, "WalkGap")
        .field("at_least", &NearestPart::at_least, "no part is nearer");
    add_answer(nearest);
    PlainBinder<NearParts> near(module, "NearParts",
                                "Returned by Walk.within and Walk.penetration.");
    near.property(
        "parts", [](const NearParts& self) { return records(self.parts); },
        "record array of WalkGap, sorted by part");
    add_answer(near);
    PlainBinder<TouchedParts> touched(module, "TouchedParts", "Returned by Walk.collide.");
    touched.property(
        "parts", [](const TouchedParts& self) { return part_numbers(self.parts); },
        "int64 array of shape (n,), sorted");
    add_answer(touched);
    PlainBinder<WalkPartName>(module, "WalkPartName", "A part by name.")
        .field("file", &WalkPartName::file, "empty for a part that was added")
        .field("id", &WalkPartName::id, "")
        .field("name", &WalkPartName::name, "")
        .field("type", &WalkPartName::type, "")
        .done();
    PlainBinder<WalkStatistics>(module, "WalkStatistics", "What a walk did since it began.")
        .field("lookups", &WalkStatistics::lookups, "")
        .field("misses", &WalkStatistics::misses, "")
        .field("seconds_waited", &WalkStatistics::seconds_waited, "")
        .field("read_ahead", &WalkStatistics::read_ahead, "")
        .field("read_in_query", &WalkStatistics::read_in_query, "")
        .field("evicted", &WalkStatistics::evicted, "")
        .field("parts_in_memory", &WalkStatistics::parts_in_memory, "")
        .field("table_bytes", &WalkStatistics::table_bytes, "")
        .field("bytes", &WalkStatistics::bytes, "")
        .field("peak_bytes", &WalkStatistics::peak_bytes, "")
        .done();
}

py::class_<Walker> walk_class(py::module_& module) {
    return py::class_<Walker>(
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
        .def(py::init([](const OpenStore& store, std::uint64_t memory, double look_ahead,
                         bool prefetch) {
                 return std::make_unique<Walker>(store, WalkOptions{memory, look_ahead, prefetch});
             }),
             py::arg("store"), py::kw_only(), py::arg("memory") = std::uint64_t{512} << 20,
             py::arg("look_ahead") = 3.0, py::arg("prefetch") = true)
        .def(
            "move_to",
            [](Walker& self, const py::object& position, const py::object& velocity) {
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
            "wait", [](Walker& self) { self.run([](Walk& walk) { walk.wait(); }); },
            "Waits until what is near and ahead is in memory, or memory is full.");
}

void add_walk_queries(py::class_<Walker>& type) {
    const double infinity = std::numeric_limits<double>::infinity();
    type.def(
            "distance",
            [](Walker& self, const py::object& shape, const py::object& pose, double upper_bound,
               MissingParts missing, std::int64_t except) {
                const Probe probe = to_probe(shape);
                const Transform place = to_transform(pose, "pose");
                WalkQuery query = query_of(missing, except);
                query.upper_bound = upper_bound;
                return self.run([&](Walk& walk) { return walk.distance(probe, place, query); });
            },
            py::arg("probe"), py::arg("pose"), py::kw_only(), py::arg("upper_bound") = infinity,
            py::arg("missing") = "wait", py::arg("except_part") = 0,
            "The part nearest to the probe: a NearestPart.")
        .def(
            "within",
            [](Walker& self, const py::object& shape, const py::object& pose, double tolerance,
               MissingParts missing, std::int64_t except) {
                const Probe probe = to_probe(shape);
                const Transform place = to_transform(pose, "pose");
                const WalkQuery query = query_of(missing, except);
                return self.run(
                    [&](Walk& walk) { return walk.within(probe, place, tolerance, query); });
            },
            py::arg("probe"), py::arg("pose"), py::arg("tolerance"), py::kw_only(),
            py::arg("missing") = "wait", py::arg("except_part") = 0,
            "All parts at most `tolerance` away, and how far: NearParts.")
        .def(
            "collide",
            [](Walker& self, const py::object& shape, const py::object& pose, ContactMode mode,
               MissingParts missing, std::int64_t except) {
                const Probe probe = to_probe(shape);
                const Transform place = to_transform(pose, "pose");
                WalkQuery query = query_of(missing, except);
                query.mode = mode;
                return self.run([&](Walk& walk) { return walk.collide(probe, place, query); });
            },
            py::arg("probe"), py::arg("pose"), py::kw_only(), py::arg("mode") = "all",
            py::arg("missing") = "wait", py::arg("except_part") = 0,
            "The parts that share a point with the probe: TouchedParts.")
        .def(
            "penetration",
            [](Walker& self, const py::object& shape, const py::object& pose, MissingParts missing,
               std::int64_t except) {
                const Probe probe = to_probe(shape);
                const Transform place = to_transform(pose, "pose");
                const WalkQuery query = query_of(missing, except);
                return self.run([&](Walk& walk) { return walk.penetration(probe, place, query); });
            },
            py::arg("probe"), py::arg("pose"), py::kw_only(), py::arg("missing") = "wait",
            py::arg("except_part") = 0,
            "The parts that share a point with the probe, and how deep they go into each other: "
            "NearParts.");
}

void add_walk_parts(py::class_<Walker>& type) {
    type.def(
            "add",
            [](Walker& self, const Model& model, const py::object& pose) {
                const Transform place = to_transform(pose, "pose");
                return self.run([&](Walk& walk) { return walk.add(model, place); }).number;
            },
            py::arg("model"), py::arg("pose"),
            "Brings in a part that is not in the store; returns its number.")
        .def(
            "move",
            [](Walker& self, std::int64_t part, const py::object& pose) {
                const Transform place = to_transform(pose, "pose");
                self.run([&](Walk& walk) { walk.move({part}, place); });
            },
            py::arg("part"), py::arg("pose"),
            "Puts a part elsewhere, for this walk. Error (bad_argument) if there is no such part.")
        .def(
            "remove",
            [](Walker& self, std::int64_t part) {
                self.run([&](Walk& walk) { walk.remove({part}); });
            },
            py::arg("part"), "Takes a part out, for this walk.")
        .def(
            "name",
            [](Walker& self, std::int64_t part) {
                return self.run([&](Walk& walk) { return walk.name({part}); });
            },
            py::arg("part"), "A WalkPartName.")
        .def(
            "world_from_part",
            [](Walker& self, std::int64_t part) {
                return self.run([&](Walk& walk) { return walk.world_from_part({part}); });
            },
            py::arg("part"), "The part's pose, a matrix of shape (4, 4).")
        .def(
            "model",
            [](Walker& self, std::int64_t part) {
                return self.run([&](Walk& walk) { return walk.model({part}); });
            },
            py::arg("part"), "The part's Model.")
        .def_property_readonly("statistics", [](Walker& self) {
            return self.run([](Walk& walk) { return walk.statistics(); });
        });
}

} // namespace

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
    add_walk_parts(walk);
}

} // namespace abut::python
