#include <abut/rigid_shape.h>
#include <abut/world.h>

#include "bodies/bodies.h"
#include "module.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace abut::python {

namespace {

RigidShape to_rigid_shape(const py::object& shape) {
    return with_rigid_shape(shape, "HalfSpace",
                            [](const auto& rigid) { return RigidShape(rigid); });
}

/// Asks a world about the bodies of some groups that a function accepts.
template <class Question>
auto ask(Bodies& self, std::uint32_t groups, const py::object& filter, const py::object& report,
         const Question& question) {
    BodyQuery query{.groups = groups};
    const std::unique_ptr<Callback> callback = body_callback(filter);
    if (callback)
        query.filter = [&callback](BodyId body) {
            bool keep = false;
            callback->call([&](const py::object& function) {
                keep = to_bool(function(number_of(body)), "filter");
            });
            return keep;
        };
    auto result = self.query(report, [&](World& world, const Progress& progress) {
        query.progress = progress;
        return question(world, query);
    });
    if (callback)
        callback->raise();
    return result;
}

constexpr std::uint32_t kAllGroups = ~0U;

void add_rays(py::class_<Bodies>& type) {
    type.def(
            "first_hit",
            [](Bodies& self, const py::object& origin, const py::object& direction, double t_min,
               double t_max, std::uint32_t groups, const py::object& filter,
               const py::object& report) {
                const Ray ray = to_ray(origin, direction, t_min, t_max);
                return ask(self, groups, filter, report, [&](World& world, const BodyQuery& query) {
                    return world.first_hit(ray, query);
                });
            },
            py::arg("origin"), py::arg("direction") = py::none(), py::arg("t_min") = 0.0,
            py::arg("t_max") = std::numeric_limits<double>::infinity(), py::kw_only(),
            py::arg("groups") = kAllGroups, py::arg("filter") = py::none(),
            py::arg("progress") = py::none(),
            "The first body that a ray meets: a BodyRayHit. Solids include their inside; models "
            "and "
            "deformables are\n"
            "surfaces.\n\n"
            "origin     a Ray, or its origin, shape (3,)\n"
            "direction  array of shape (3,), if the origin is no Ray\n"
            "groups     bits: bodies that belong to one of these groups\n"
            "filter     function of a body that tells whether it is asked about")
        .def(
            "all_hits",
            [](Bodies& self, const py::object& origin, const py::object& direction, double t_min,
               double t_max, std::uint32_t groups, const py::object& filter,
               const py::object& report) {
                const Ray ray = to_ray(origin, direction, t_min, t_max);
                return records(
                    ask(self, groups, filter, report, [&](World& world, const BodyQuery& query) {
                        return world.all_hits(ray, query);
                    }));
            },
            py::arg("origin"), py::arg("direction") = py::none(), py::arg("t_min") = 0.0,
            py::arg("t_max") = std::numeric_limits<double>::infinity(), py::kw_only(),
            py::arg("groups") = kAllGroups, py::arg("filter") = py::none(),
            py::arg("progress") = py::none(),
            "The first point of each body that a ray meets, sorted along it: a record array of "
            "BodyRayHit. Otherwise as\n"
            "first_hit.");
}

void add_shapes(py::class_<Bodies>& type) {
    type.def(
            "overlaps",
            [](Bodies& self, const py::object& shape, const py::object& pose, std::uint32_t groups,
               const py::object& filter, const py::object& report) {
                const RigidShape asked = to_rigid_shape(shape);
                const Pose place = to_pose(pose, "pose");
                const std::vector<BodyId> found =
                    ask(self, groups, filter, report, [&](World& world, const BodyQuery& query) {
                        return world.overlaps(asked, place, query);
                    });
                std::vector<std::int64_t> bodies;
                bodies.reserve(found.size());
                for (const BodyId body : found)
                    bodies.push_back(number_of(body));
                return numbers(std::move(bodies));
            },
            py::arg("shape"), py::arg("pose") = py::none(), py::kw_only(),
            py::arg("groups") = kAllGroups, py::arg("filter") = py::none(),
            py::arg("progress") = py::none(),
            "The bodies that share a point with a shape, sorted: int64 array of shape (n,). As "
            "collide would tell it of a\n"
            "body in that place.\n\n"
            "shape   a Model, Convex, Sphere, Capsule, Box3, Cylinder, Cone, Ellipsoid or "
            "HalfSpace\n"
            "groups  bits: bodies that belong to one of these groups\n"
            "filter  function of a body that tells whether it is asked about")
        .def(
            "sweep",
            [](Bodies& self, const py::object& shape, const py::object& motion,
               std::uint32_t groups, const py::object& filter, std::optional<double> absolute_error,
               std::optional<std::uint64_t> max_steps, const py::object& report) {
                const RigidShape asked = to_rigid_shape(shape);
                const auto& way = get<Motion>(motion, "motion");
                const ImpactOptions options{.absolute_error = absolute_error,
                                            .max_steps = max_steps};
                return ask(self, groups, filter, report, [&](World& world, const BodyQuery& query) {
                    return world.sweep(asked, way, query, options);
                });
            },
            py::arg("shape"), py::arg("motion"), py::kw_only(), py::arg("groups") = kAllGroups,
            py::arg("filter") = py::none(), py::arg("absolute_error") = py::none(),
            py::arg("max_steps") = py::none(), py::arg("progress") = py::none(),
            "The first body that a moving shape meets, where the bodies stay: a BodySweepHit. "
            "Otherwise as overlaps and\n"
            "time_of_impact.");
}

} // namespace

void bind_question_results(py::module_& module) {
    RecordBinder<BodyRayHit> hit(module, "BodyRayHit",
                                 "Where a ray first meets a body. True if it meets one.");
    hit.field("meet", &BodyRayHit::meet, "if False, nothing else is set")
        .field("body", &BodyRayHit::body, "body")
        .field("t", &BodyRayHit::t, "the ray's parameter; inf if it meets nothing")
        .field("point", &BodyRayHit::point, "world frame")
        .field("normal", &BodyRayHit::normal,
               "unit vector out of the body; of a surface, towards the ray's origin; zero if the "
               "ray begins inside a solid")
        .field("triangle", &BodyRayHit::triangle, "of a model or deformable; else 0")
        .field("piece", &BodyRayHit::piece, "of a Compound; else 0");
    hit.done().def("__bool__", [](const BodyRayHit& self) { return self.meet; });
    RecordBinder<BodySweepHit> sweep(
        module, "BodySweepHit", "The first body that a moving shape meets. True if it meets one.");
    sweep.field("meet", &BodySweepHit::meet, "if False, only the time is set: 1")
        .field("body", &BodySweepHit::body, "body")
        .inner("time", &BodySweepHit::impact, &Impact::time,
               "in [0, 1], never later than the first contact")
        .inner("contact_time", &BodySweepHit::impact, &Impact::contact_time,
               "a time at which they are in contact")
        .inner("gap", &BodySweepHit::impact, &Impact::gap,
               "length: how far apart they are at `time`, at most")
        .inner("point_a", &BodySweepHit::impact, &Impact::point_a, "on the body at `time`")
        .inner("point_b", &BodySweepHit::impact, &Impact::point_b, "on the shape at `time`")
        .inner("normal", &BodySweepHit::impact, &Impact::normal,
               "unit vector from the body to the shape")
        .inner("triangle_a", &BodySweepHit::impact, &Impact::triangle_a, "of a model; else 0")
        .inner("triangle_b", &BodySweepHit::impact, &Impact::triangle_b, "of a model; else 0")
        .inner("status", &BodySweepHit::impact, &Impact::status, "Status")
        .field("piece", &BodySweepHit::piece, "of a Compound; else 0");
    sweep.done().def("__bool__", [](const BodySweepHit& self) { return self.meet; });
}

void add_world_questions(py::class_<Bodies>& type) {
    add_rays(type);
    add_shapes(type);
}

} // namespace abut::python
