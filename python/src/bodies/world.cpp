#include <abut/world.h>

#include "bodies/bodies.h"
#include "module.h"

#include <array>
#include <limits>

namespace abut::python {

/// The points of a manifold as a field of four records.
template <>
struct FieldFormat<std::array<ContactPoint, 4>> {
    static py::object make() {
        return py::make_tuple(record_type<ContactPoint>().dtype, py::make_tuple(4));
    }
};

namespace {

std::vector<BodyMotion> to_body_motions(const py::object& motions) {
    std::vector<BodyMotion> list;
    const auto add = [&list](const py::handle& body, const py::handle& motion) {
        list.push_back({body.cast<BodyId>(), get<Motion>(motion, "motions")});
    };
    if (PyDict_Check(motions.ptr())) {
        for (const auto& [body, motion] : py::reinterpret_borrow<py::dict>(motions))
            add(body, motion);
        return list;
    }
    for (const py::handle item : motions) {
        const auto pair = py::reinterpret_borrow<py::sequence>(item);
        add(py::object(pair[0]), py::object(pair[1]));
    }
    return list;
}

BodyOptions body_options(bool is_static, std::uint32_t groups, std::uint32_t mask,
                         std::uint64_t user_data) {
    return {.is_static = is_static, .groups = groups, .mask = mask, .user_data = user_data};
}

py::array pairs_of(const std::vector<BodyPair>& pairs) {
    std::vector<std::array<std::int64_t, 2>> numbers;
    numbers.reserve(pairs.size());
    for (const BodyPair& pair : pairs)
        numbers.push_back({number_of(pair.a), number_of(pair.b)});
    return rows<std::int64_t>(std::move(numbers));
}

void bind_contacts(py::module_& module) {
    RecordBinder<ContactPoint>(module, "ContactPoint", "A point of a ContactManifold.")
        .field("point_a", &ContactPoint::point_a, "on a")
        .field("point_b", &ContactPoint::point_b, "on b")
        .field("depth", &ContactPoint::depth, "length along the normal; negative: a gap")
        .field("feature", &ContactPoint::feature,
               "names the two features that make the point; stays while they do")
        .field("triangle_a", &ContactPoint::triangle_a,
               "of a model or deformable: the triangle of the contact; else 0")
        .field("triangle_b", &ContactPoint::triangle_b, "as triangle_a")
        .done();
    RecordBinder<ContactManifold>(module, "ContactManifold",
                                  "A region where two bodies are in contact, world frame.")
        .field("a", &ContactManifold::a, "body")
        .field("b", &ContactManifold::b, "body")
        .field("normal", &ContactManifold::normal, "unit vector from a to b")
        .field("region", &ContactManifold::region,
               "names the contact region of this pair; 0 for convex bodies")
        .field("piece_a", &ContactManifold::piece_a, "of a Compound; else 0")
        .field("piece_b", &ContactManifold::piece_b, "of a Compound; else 0")
        .field("user_data_a", &ContactManifold::user_data_a, "of the body, as add takes it")
        .field("user_data_b", &ContactManifold::user_data_b, "as user_data_a")
        .field("count", &ContactManifold::count, "of the points that are set")
        .field("points", &ContactManifold::points, "list of ContactPoint: four, the deepest first")
        .field("status", &ContactManifold::status,
               "Status; bound_only: of two models, along the normal; else as of BodyGap")
        .done();
}

void bind_world_results(py::module_& module) {
    RecordBinder<BodyGap>(module, "BodyGap", "How two bodies lie to each other, world frame.")
        .field("a", &BodyGap::a, "body")
        .field("b", &BodyGap::b, "body")
        .field("distance", &BodyGap::distance,
               "length; 0 if they touch, minus the depth if they interpenetrate")
        .field("point_a", &BodyGap::point_a, "on a")
        .field("point_b", &BodyGap::point_b, "on b: point_a + distance * normal, to rounding")
        .field("normal", &BodyGap::normal, "unit vector from a to b; zero where none is known")
        .field("triangle_a", &BodyGap::triangle_a, "of a model; else 0")
        .field("triangle_b", &BodyGap::triangle_b, "of a model; else 0")
        .field("piece_a", &BodyGap::piece_a, "of a Compound; else 0")
        .field("piece_b", &BodyGap::piece_b, "of a Compound; else 0")
        .field("status", &BodyGap::status,
               "Status; bound_only: with a model, they go at least so deep into each other; two "
               "solids, and models that coincide, may be separated by a shorter motion")
        .done();
    RecordBinder<BodyImpact>(module, "BodyImpact", "A pair of bodies that meet in a step.")
        .field("a", &BodyImpact::a, "body")
        .field("b", &BodyImpact::b, "body")
        .inner("time", &BodyImpact::impact, &Impact::time,
               "in [0, 1], never later than the first contact")
        .inner("contact_time", &BodyImpact::impact, &Impact::contact_time,
               "a time at which they are in contact")
        .inner("gap", &BodyImpact::impact, &Impact::gap,
               "length: how far apart they are at `time`, at most")
        .inner("point_a", &BodyImpact::impact, &Impact::point_a, "on a at `time`")
        .inner("point_b", &BodyImpact::impact, &Impact::point_b, "on b at `time`")
        .inner("normal", &BodyImpact::impact, &Impact::normal, "unit vector from a to b")
        .inner("triangle_a", &BodyImpact::impact, &Impact::triangle_a, "of a model; else 0")
        .inner("triangle_b", &BodyImpact::impact, &Impact::triangle_b, "of a model; else 0")
        .inner("status", &BodyImpact::impact, &Impact::status, "Status")
        .field("piece_a", &BodyImpact::piece_a, "of a Compound; else 0")
        .field("piece_b", &BodyImpact::piece_b, "of a Compound; else 0")
        .done();
    RecordBinder<ScheduleCounters>(module, "ScheduleCounters", "The work that `advance` has done.")
        .field("steps", &ScheduleCounters::steps, "")
        .field("pairs", &ScheduleCounters::pairs, "that may ever meet, summed over the steps")
        .field("estimates", &ScheduleCounters::estimates, "of these, those that were due")
        .field("distance_queries", &ScheduleCounters::distance_queries,
               "of these, those that boxes and planes did not decide")
        .done();
}

py::class_<Bodies> world_class(py::module_& module) {
    return py::class_<Bodies>(
               module, "World",
               "World(*, broad_phase='automatic', filter=None)\n\n"
               "Many bodies that move: which of them meet, how near they are, when they may meet. "
               "A model "
               "is its surface;\n"
               "all other shapes are solid. A world keeps its models and "
               "deformables "
               "alive.\n\n"
               "A body is a BodyId, an int; it is valid until the body is removed, and then never "
               "again.\n\n"
               "broad_phase  a BroadPhaseMethod\n"
               "filter       function of two bodies, a before b, that tells whether they may meet; "
               "called "
               "from any thread.\n"
               "             What it says may change only with refilter(). If it raises, the pair "
               "counts "
               "as filtered out\n"
               "             and the call that asked raises the same\n\n"
               "One thread at a time may use a world: a second one gets RuntimeError. Queries give "
               "sorted "
               "results, the same\n"
               "for any number of threads, and stop at Ctrl-C; the world is as before then.")
        .def(py::init<BroadPhaseMethod, py::object>(), py::kw_only(),
             py::arg("broad_phase") = "automatic", py::arg("filter") = py::none())
        .def(
            "add",
            [](Bodies& self, const py::object& shape, const py::object& pose, bool is_static,
               std::uint32_t groups, std::uint32_t mask, std::uint64_t user_data) {
                return self.add(shape, pose, body_options(is_static, groups, mask, user_data));
            },
            py::arg("shape"), py::arg("pose") = py::none(), py::kw_only(),
            py::arg("is_static") = false, py::arg("groups") = 1U, py::arg("mask") = ~0U,
            py::arg("user_data") = 0U,
            "Adds a Model, Convex, Sphere, Capsule, Box3, Cylinder, Cone, Ellipsoid, HalfSpace, "
            "Compound, ConvexPieces or Deformable;\n"
            "returns its body, a BodyId.\n\n"
            "pose       rigid: a matrix of shape (4, 4), (translation, quaternion) or a Pose; none "
            "for a Deformable\n"
            "is_static  static bodies do not meet each other\n"
            "groups     bits: the groups that the body belongs to\n"
            "mask       bits: the groups that it meets; both bodies must agree\n"
            "user_data  a number of yours, at least 0; contacts carry it\n\n"
            "Raises Error (bad_argument) if a value is not finite or a shape is not valid; "
            "ValueError for a matrix that is\n"
            "no rotation and translation.")
        .def("move", &Bodies::move, py::arg("body"), py::arg("pose"),
             "Moves a body; or many: an array of bodies of shape (n,) and one of poses of shape "
             "(n, 4, 4).\n\n"
             "Raises Error (bad_argument) if the body is not valid or is a deformable. A BodyId of "
             "another World is not valid;\n"
             "the integers of an array do not tell their World.")
        .def(
            "refresh",
            [](Bodies& self, BodyId body) { self.run([&](World& world) { world.refresh(body); }); },
            py::arg("body"), "Says that a deformable has another step.")
        .def("remove", &Bodies::remove, py::arg("body"),
             "Removes a body. Error (bad_argument) if it is not valid.");
}

void add_world_state(py::class_<Bodies>& type) {
    type.def(
            "set_options",
            [](Bodies& self, BodyId body, bool is_static, std::uint32_t groups, std::uint32_t mask,
               std::uint64_t user_data) {
                self.quick([&](World& world) {
                    world.set_options(body, body_options(is_static, groups, mask, user_data));
                });
            },
            py::arg("body"), py::kw_only(), py::arg("is_static") = false, py::arg("groups") = 1U,
            py::arg("mask") = ~0U, py::arg("user_data") = 0U,
            "Changes which bodies the body can meet.")
        .def(
            "options",
            [](Bodies& self, BodyId body) {
                const BodyOptions options =
                    self.quick([&](World& world) { return world.options(body); });
                return py::dict(py::arg("is_static") = options.is_static,
                                py::arg("groups") = options.groups, py::arg("mask") = options.mask,
                                py::arg("user_data") = options.user_data);
            },
            py::arg("body"), "What set_options takes: a dict.")
        .def(
            "set_user_data",
            [](Bodies& self, BodyId body, std::uint64_t user_data) {
                self.quick([&](World& world) { world.set_user_data(body, user_data); });
            },
            py::arg("body"), py::arg("user_data"),
            "Changes the number that contacts of the body carry.")
        .def(
            "refilter", [](Bodies& self) { self.quick([](World& world) { world.refilter(); }); },
            "Says that the filter has changed.")
        .def(
            "is_valid",
            [](Bodies& self, BodyId body) {
                return self.quick([&](World& world) { return world.is_valid(body); });
            },
            py::arg("body"))
        .def("__len__",
             [](Bodies& self) { return self.quick([](World& world) { return world.size(); }); })
        .def(
            "index_end",
            [](Bodies& self) { return self.quick([](World& world) { return world.index_end(); }); },
            "How many entries an array needs that is read by BodyId.index: often more than len(), "
            "since each piece of a\n"
            "Compound takes an index, and that of a removed body is used again only later.")
        .def(
            "world_from_body",
            [](Bodies& self, BodyId body) {
                return self.quick([&](World& world) { return world.world_from_body(body); });
            },
            py::arg("body"), "The body's pose, a matrix of shape (4, 4).")
        .def(
            "box",
            [](Bodies& self, BodyId body) {
                return self.quick([&](World& world) { return world.box(body); });
            },
            py::arg("body"), "A Box3 that encloses the body.");
}

void add_world_pairs(py::class_<Bodies>& type) {
    type.def(
            "update", [](Bodies& self) { self.run([](World& world) { world.update(); }); },
            "Finds the pairs of bodies whose boxes overlap. Every query does so first if a body "
            "has "
            "changed.")
        .def(
            "pairs",
            [](Bodies& self) {
                return pairs_of(self.run([](World& world) { return world.pairs(); }));
            },
            "Pairs of bodies whose boxes overlapped at the last update: int64 array of shape (n, "
            "2).")
        .def(
            "begun",
            [](Bodies& self) {
                return pairs_of(self.run([](World& world) { return world.begun(); }));
            },
            "Pairs that began with the last update, or with the query that made it.")
        .def(
            "ended",
            [](Bodies& self) {
                return pairs_of(self.run([](World& world) { return world.ended(); }));
            },
            "Pairs that ended with the last update, or with the query that made it.");
}

void add_world_queries(py::class_<Bodies>& type) {
    type.def(
            "collide",
            [](Bodies& self, const py::object& report) {
                return pairs_of(self.query(report, [](World& world, const Progress& progress) {
                    return world.collide(progress);
                }));
            },
            py::kw_only(), py::arg("progress") = py::none(),
            "All pairs of bodies that share a point: int64 array of shape (n, 2). Exact for "
            "models, boxes and convex\n"
            "bodies; others to rounding.")
        .def(
            "penetration",
            [](Bodies& self, const py::object& report) {
                return records(self.query(report, [](World& world, const Progress& progress) {
                    return world.penetration(progress);
                }));
            },
            py::kw_only(), py::arg("progress") = py::none(),
            "All pairs that share a point, with how deep they go into each other: a record array "
            "of BodyGap.")
        .def(
            "within",
            [](Bodies& self, double distance, const py::object& report) {
                return records(self.query(report, [&](World& world, const Progress& progress) {
                    return world.within(distance, progress);
                }));
            },
            py::arg("distance"), py::kw_only(), py::arg("progress") = py::none(),
            "All pairs at most `distance` apart, a length, and their signed distances: a record "
            "array of BodyGap. Pairs that share\n"
            "a point are as in penetration. Error (bad_argument) if the distance is negative.")
        .def(
            "time_of_impact",
            [](Bodies& self, const py::object& motions, std::optional<double> absolute_error,
               std::optional<std::uint64_t> max_steps, const py::object& report) {
                const auto list = to_body_motions(motions);
                ImpactOptions options{.absolute_error = absolute_error, .max_steps = max_steps};
                return records(self.query(report, [&](World& world, const Progress& progress) {
                    options.progress = progress;
                    return world.time_of_impact(list, options);
                }));
            },
            py::arg("motions"), py::kw_only(), py::arg("absolute_error") = py::none(),
            py::arg("max_steps") = py::none(), py::arg("progress") = py::none(),
            "When bodies that move first meet, each pair once: a record array of BodyImpact.\n\n"
            "motions  a dict of body to Motion, or a list of (body, Motion); others stay where "
            "they are, and\n"
            "         deformables move as their steps say. Two bodies at rest are no pair\n\n"
            "Bodies that share a point at t = 0 have the time 0, a zero normal, and one point of "
            "both "
            "for point_a and\n"
            "point_b.");
}

void add_world_contacts(py::class_<Bodies>& type) {
    type.def(
        "contact_manifolds",
        [](Bodies& self, double margin, const py::object& report) {
            return records(self.query(report, [&](World& world, const Progress& progress) {
                return world.contact_manifolds(margin, progress);
            }));
        },
        py::arg("margin") = 0.0, py::kw_only(), py::arg("progress") = py::none(),
        "The contacts of all pairs at most `margin` apart, a length: for each region a normal "
        "and up to four points.\n"
        "A simulator's margin is at least the largest speed times the step; time_of_impact finds "
        "what is faster. A\n"
        "record array of ContactManifold. A body inside a closed model, clear of its surface, is "
        "apart from it by the\n"
        "distance of that surface. Error (bad_argument) if the margin is negative.");
}

void add_world_schedule(py::class_<Bodies>& type) {
    type.def(
            "set_speed",
            [](Bodies& self, BodyId body, const py::object& velocity,
               const py::object& acceleration, double acceleration_bound, double angular_speed,
               double angular_acceleration, const py::object& angular_velocity) {
                const SpeedBounds bounds{to_vec3(velocity, "velocity"),
                                         to_vec3(acceleration, "acceleration"),
                                         acceleration_bound,
                                         angular_speed,
                                         angular_acceleration,
                                         to_vec3(angular_velocity, "angular_velocity")};
                self.quick([&](World& world) { world.set_speed(body, bounds); });
            },
            py::arg("body"), py::arg("velocity") = py::make_tuple(0, 0, 0),
            py::arg("acceleration") = py::make_tuple(0, 0, 0), py::arg("acceleration_bound") = 0.0,
            py::arg("angular_speed") = 0.0, py::arg("angular_acceleration") = 0.0,
            py::arg("angular_velocity") = py::make_tuple(0, 0, 0),
            "Bounds on the body's motion from its place and the time of the last `advance`. Call "
            "it before `move`.\n\n"
            "velocity, acceleration  of its origin, as far as they are known\n"
            "acceleration_bound      length of another acceleration, at most\n"
            "angular_velocity        known, about its origin: radians per unit of time\n"
            "angular_speed           length of another angular velocity, at most\n"
            "angular_acceleration    how fast that may grow, at most\n\n"
            "A deformable needs no bounds: it is tested anew after each refresh.")
        .def(
            "advance",
            [](Bodies& self, double time, const py::object& report) {
                return pairs_of(self.query(report, [&](World& world, const Progress& progress) {
                    return world.advance(time, progress);
                }));
            },
            py::arg("time"), py::kw_only(), py::arg("progress") = py::none(),
            "Lets time pass, and returns the pairs that share a point at the places that the "
            "bodies have now. Looks only\n"
            "at pairs that may have met by then.")
        .def(
            "next_event",
            [](Bodies& self) { return self.run([](World& world) { return world.next_event(); }); },
            "For so long from the last `advance` on, no pair that does not touch now can begin "
            "to.");
}

void add_world_estimates(py::class_<Bodies>& type) {
    type.def(
            "time_to_collision",
            [](Bodies& self, std::optional<BodyId> a, std::optional<BodyId> b, double limit,
               const py::object& report) {
                if (a.has_value() != b.has_value())
                    throw py::value_error("time_to_collision: two bodies, or none");
                return self.query(report, [&](World& world, const Progress& progress) {
                    return a ? world.time_to_collision(*a, *b)
                             : world.time_to_collision(limit, progress);
                });
            },
            py::arg("a") = py::none(), py::arg("b") = py::none(), py::kw_only(),
            py::arg("limit") = std::numeric_limits<double>::infinity(),
            py::arg("progress") = py::none(),
            "Of all bodies: as `next_event`, however far ahead, but at most `limit`; infinite if "
            "no bodies can ever meet.\n"
            "Of two: for so long from the last `advance` on, they cannot begin to touch; 0 if they "
            "touch.\n\n"
            "Raises Error (bad_argument) if the limit is negative, a body is not valid or both are "
            "the same.")
        .def("schedule_counters",
             [](Bodies& self) {
                 return self.quick([](World& world) { return world.schedule_counters(); });
             })
        .def("__repr__", [](Bodies& self) {
            return "<abut.World: " +
                   std::to_string(self.quick([](World& world) { return world.size(); })) +
                   " bodies>";
        });
}

} // namespace

void bind_world(py::module_& module) {
    bind_body_id(module);
    bind_compound(module);
    bind_contacts(module);
    bind_world_results(module);
    bind_question_results(module);
    auto world = world_class(module);
    add_world_state(world);
    add_world_pairs(world);
    add_world_queries(world);
    add_world_contacts(world);
    add_world_questions(world);
    add_world_schedule(world);
    add_world_estimates(world);
}

} // namespace abut::python
