#include <abut/shape_queries.h>

#include "module.h"
#include "queries/queries.h"

namespace abut::python {

Ray to_ray(const py::object& origin, const py::object& direction, double t_min, double t_max) {
    if (const Ray* ray = peek<Ray>(origin))
        return *ray;
    if (direction.is_none())
        throw py::type_error("origin: a Ray, or origin and direction are wanted");
    return {to_vec3(origin, "origin"), to_vec3(direction, "direction"), t_min, t_max};
}

namespace {

bool a_model(PyObject* first, PyObject* /*third*/) {
    return is_a<Model>(first);
}

py::object run_nearest(const Arguments& arguments) {
    const Model& model = get<Model>(arguments[0], "model");
    const Transform pose = to_transform(arguments[1], "pose");
    const PointArgument points = to_point_or_points(arguments[2], "points");
    NearestOptions options;
    arguments.take(3, "upper_bound", options.upper_bound);
    arguments.take(4, "signed_distance", options.signed_distance);
    Work work(arguments[5]);
    if (points.many)
        return records(work.run([&](const Progress& progress) {
            options.progress = progress;
            return nearest(model, pose, points.list, options);
        }));
    return py::cast(work.run([&](const Progress& progress) {
        options.progress = progress;
        return nearest(model, pose, points.one, options);
    }));
}

py::object run_contains(const Arguments& arguments) {
    const Model& model = get<Model>(arguments[0], "model");
    const Transform pose = to_transform(arguments[1], "pose");
    const PointArgument points = to_point_or_points(arguments[2], "points");
    Work work(arguments[3]);
    if (points.many)
        return records(work.run([&](const Progress& progress) {
            return contains(model, pose, points.list, progress);
        }));
    return py::cast(work.run(
        [&](const Progress& progress) { return contains(model, pose, points.one, progress); }));
}

/// The ends of rays: one number for all, or one for each.
std::vector<double> to_numbers(py::handle object, const char* name, double otherwise,
                               BatchSize& size) {
    if (object.is_none())
        return {otherwise};
    const auto array = double_array(object, name);
    if (array.ndim() == 0)
        return {*array.data()};
    if (array.ndim() != 1)
        throw py::value_error(std::string(name) + ": a number or an array of shape (n,) is wanted");
    size.add(true, static_cast<std::size_t>(array.size()), name);
    return {array.data(), array.data() + array.size()};
}

struct RayArgument {
    bool many = false;
    std::vector<Ray> list;
};

/// In: arguments 2 to 5: a Ray; or origins, directions, t_min and t_max.
RayArgument to_rays(const Arguments& arguments) {
    if (const Ray* ray = peek<Ray>(arguments[2]))
        return {false, {*ray}};
    if (!arguments.has(3))
        throw py::type_error("origin: a Ray, or origin and direction are wanted");
    const PointArgument origins = to_point_or_points(arguments[2], "origin");
    const PointArgument directions = to_point_or_points(arguments[3], "direction");
    BatchSize size;
    size.add(origins.many, origins.list.size(), "origin");
    size.add(directions.many, directions.list.size(), "direction");
    const auto t_min = to_numbers(arguments[4], "t_min", 0, size);
    const auto t_max =
        to_numbers(arguments[5], "t_max", std::numeric_limits<double>::infinity(), size);
    RayArgument result{size.many(), std::vector<Ray>(size.size())};
    const bool many_min = arguments.has(4) && t_min.size() == size.size();
    const bool many_max = arguments.has(5) && t_max.size() == size.size();
    for (std::size_t i = 0; i < result.list.size(); ++i)
        result.list[i] = {origins.at(i), directions.at(i), t_min[many_min ? i : 0],
                          t_max[many_max ? i : 0]};
    return result;
}

py::object run_first_hit(const Arguments& arguments) {
    const Model& model = get<Model>(arguments[0], "model");
    const Transform pose = to_transform(arguments[1], "pose");
    const RayArgument rays = to_rays(arguments);
    Work work(arguments[6]);
    if (rays.many)
        return records(work.run(
            [&](const Progress& progress) { return first_hit(model, pose, rays.list, progress); }));
    return py::cast(work.run(
        [&](const Progress& progress) { return first_hit(model, pose, rays.list[0], progress); }));
}

py::object run_all_hits(const Arguments& arguments) {
    const Model& model = get<Model>(arguments[0], "model");
    const Transform pose = to_transform(arguments[1], "pose");
    const RayArgument rays = to_rays(arguments);
    Work work(arguments[6]);
    if (!rays.many)
        return records(work.run([&](const Progress& progress) {
            return all_hits(model, pose, rays.list[0], progress);
        }));
    const auto all = work.run([&](const Progress& progress) {
        std::vector<std::vector<RayHit>> hits;
        for (const Ray& ray : rays.list)
            hits.push_back(all_hits(model, pose, ray, progress));
        return hits;
    });
    py::list list;
    for (const auto& hits : all)
        list.append(records(hits));
    return list;
}

/// Calls `use` with the shape of argument 2: a Sphere, Box3, OrientedBox or Segment.
template <class Use>
auto with_shape(py::handle object, Use&& use) {
    if (const auto* sphere = peek<Sphere>(object))
        return use(*sphere);
    if (const auto* box = peek<Box3>(object))
        return use(*box);
    if (const auto* box = peek<OrientedBox>(object))
        return use(*box);
    if (const auto* segment = peek<Segment>(object))
        return use(*segment);
    throw py::type_error(
        "shape: a Sphere, Box3, OrientedBox or Segment, or the corners of boxes are wanted");
}

bool model_and_shape(PyObject* first, PyObject* third) {
    return is_a<Model>(first) && (is_a<Sphere>(third) || is_a<Box3>(third) ||
                                  is_a<OrientedBox>(third) || is_a<Segment>(third));
}

py::object run_overlaps(const Arguments& arguments) {
    const Model& model = get<Model>(arguments[0], "model");
    const Transform pose = to_transform(arguments[1], "pose");
    Work work(arguments[3]);
    return with_shape(arguments[2], [&](const auto& shape) -> py::object {
        return py::bool_(work.run(
            [&](const Progress& progress) { return overlaps(model, pose, shape, progress); }));
    });
}

py::object run_boxes_overlap(const Arguments& arguments) {
    const Model& model = get<Model>(arguments[0], "model");
    const Transform pose = to_transform(arguments[1], "pose");
    const PointArgument lower = to_point_or_points(arguments[2], "lower");
    const PointArgument upper = to_point_or_points(arguments[3], "upper");
    Work work(arguments[4]);
    BatchSize size;
    size.add(lower.many, lower.list.size(), "lower");
    size.add(upper.many, upper.list.size(), "upper");
    const auto answers = work.run([&](const Progress& progress) {
        std::vector<bool> list;
        for (std::size_t i = 0; i < size.size(); ++i)
            list.push_back(overlaps(model, pose, Box3{lower.at(i), upper.at(i)}, progress));
        return list;
    });
    return size.many() ? py::object(booleans(answers)) : py::bool_(answers[0]);
}

py::object run_overlapping_triangles(const Arguments& arguments) {
    const Model& model = get<Model>(arguments[0], "model");
    const Transform pose = to_transform(arguments[1], "pose");
    Work work(arguments[3]);
    return with_shape(arguments[2], [&](const auto& shape) -> py::object {
        return numbers(work.run([&](const Progress& progress) {
            return overlapping_triangles(model, pose, shape, progress);
        }));
    });
}

bool model_and_segment(PyObject* first, PyObject* third) {
    return is_a<Model>(first) && is_a<Segment>(third);
}

py::object run_segment_distance(const Arguments& arguments) {
    const Model& model = get<Model>(arguments[0], "model");
    const Transform pose = to_transform(arguments[1], "pose");
    const auto& segment = get<Segment>(arguments[2], "segment");
    DistanceOptions options;
    arguments.take(3, "upper_bound", options.upper_bound);
    arguments.take(4, "absolute_error", options.absolute_error);
    arguments.take(5, "relative_error", options.relative_error);
    arguments.take(6, "max_steps", options.max_steps);
    Work work(arguments[7]);
    return py::cast(work.run([&](const Progress& progress) {
        options.progress = progress;
        return distance(model, pose, segment, options);
    }));
}

constexpr const char* kRay =
    "model      Model\n"
    "pose       one pose, as for collide\n"
    "origin     a Ray; or an array of shape (3,) or (n, 3)\n"
    "direction  array of shape (3,) or (n, 3), of any length but 0\n"
    "t_min      number or array of shape (n,): where rays begin, in lengths of the direction\n"
    "t_max      number or array of shape (n,): where they end\n"
    "progress   function of (stage, fraction)\n\n";

void bind_shape_results(py::module_& module) {
    bind_enum<HitSide>(module, "HitSide", {"front", "back", "along"},
                       "Which side of a triangle a ray comes from.");
    bind_enum<Side>(module, "Side", {"outside", "inside", "on_surface"}, "Where a point is.");
    bind_enum<ContainmentMethod>(
        module, "ContainmentMethod", {"crossings", "winding"},
        "How contains decided: crossings, exact, for closed models; else the winding number.");
    RecordBinder<Nearest>(module, "Nearest", "Returned by nearest: a point of the surface.")
        .field("distance", &Nearest::distance, "length; negative inside if signed_distance")
        .field("point", &Nearest::point, "on the surface, world frame")
        .field("triangle", &Nearest::triangle, "with the point; the least of several")
        .field("feature", &Nearest::feature, "Feature of the triangle that the point lies on")
        .field("index", &Nearest::index, "which vertex or edge")
        .field("barycentric", &Nearest::barycentric, "weights of the triangle's vertices")
        .field("status", &Nearest::status,
               "Status; bound_only: no point is nearer than upper_bound")
        .done();
    auto hit = RecordBinder<RayHit>(module, "RayHit",
                                    "Returned by first_hit. True if the ray meets the model.");
    hit.field("meet", &RayHit::meet, "whether the ray meets a triangle")
        .field("t", &RayHit::t, "the ray's parameter; inf if it meets nothing")
        .field("point", &RayHit::point, "on the triangle, world frame")
        .field("triangle", &RayHit::triangle, "the least of several at the same t")
        .field("barycentric", &RayHit::barycentric, "weights of its vertices")
        .field("side", &RayHit::side, "HitSide");
    hit.done().def("__bool__", [](const RayHit& self) { return self.meet; });
    RecordBinder<Containment>(module, "Containment", "Returned by contains.")
        .field("side", &Containment::side, "Side")
        .field("method", &Containment::method, "ContainmentMethod")
        .field("winding_number", &Containment::winding_number, "if the method is winding; else 0")
        .done();
}

void bind_point_and_ray_verbs(py::module_& module) {
    add_verb(module, "nearest",
             "nearest(model, pose, points, *, upper_bound=inf, signed_distance=False, "
             "progress=None)\n--\n\n"
             "The surface point nearest to each point.\n\n"
             "model            Model\n"
             "pose             one pose, as for collide\n"
             "points           array of shape (3,) or (n, 3), world frame\n"
             "upper_bound      length; greater distances are not computed\n"
             "signed_distance  negative strictly inside; Error (bad_argument) if the model is not "
             "closed\n"
             "progress         function of (stage, fraction)\n\n"
             "Returns Nearest, or a record array of shape (n,), computed in parallel. Raises Error "
             "(bad_argument) if a\n"
             "value is not finite or beyond 1e18.");
    static const std::string first_doc =
        std::string("first_hit(model, pose, origin, direction=None, t_min=0, t_max=inf, *, "
                    "progress=None)\n--\n\n"
                    "The first triangle that each ray meets.\n\n") +
        kRay +
        "Returns RayHit, or a record array of shape (n,), computed in parallel. Which triangles "
        "are met is\n"
        "exact; a ray through an edge slips through nowhere. Raises Error (bad_argument) for a "
        "zero direction.";
    add_verb(module, "first_hit", first_doc.c_str());
    static const std::string all_doc =
        std::string("all_hits(model, pose, origin, direction=None, t_min=0, t_max=inf, *, "
                    "progress=None)\n--\n\n"
                    "Every triangle that each ray meets, sorted by t, then by index.\n\n") +
        kRay +
        "Returns a record array with the fields of RayHit; for many rays a list of them. Otherwise "
        "as first_hit.";
    add_verb(module, "all_hits", all_doc.c_str());
    add_verb(module, "contains",
             "contains(model, pose, points, *, progress=None)\n--\n\n"
             "Whether each point lies inside the model, outside or on its surface.\n\n"
             "model     Model. A closed one is decided exactly, another by its winding number\n"
             "pose      one pose, as for collide\n"
             "points    array of shape (3,) or (n, 3), world frame\n"
             "progress  function of (stage, fraction)\n\n"
             "Returns Containment, or a record array of shape (n,), computed in parallel:\n"
             "contains(model, None, points).side == Side.inside is an array of bool.");
}

void bind_shape_verbs(py::module_& module) {
    add_verb(module, "overlaps",
             "overlaps(model, pose, shape, *, progress=None)\noverlaps(model, pose, lower, upper, "
             "*, progress=None)\n\n"
             "Whether the surface and a solid shape share a point. Exact; touching counts.\n\n"
             "model         Model, as a surface: a shape wholly inside a closed one does not "
             "overlap it\n"
             "pose          one pose, as for collide\n"
             "shape         Sphere, Box3, OrientedBox or Segment, world frame\n"
             "lower, upper  corners of boxes, arrays of shape (3,) or (n, 3)\n"
             "progress      function of (stage, fraction)\n\n"
             "Returns a bool; for many boxes an array of bool of shape (n,), computed one after "
             "another.");
    add_verb(module, "overlapping_triangles",
             "overlapping_triangles(model, pose, shape, *, progress=None)\n--\n\n"
             "The triangles that share a point with a Sphere, Box3, OrientedBox or Segment, as a "
             "sorted uint32 array of\n"
             "shape (n,). Otherwise as overlaps.");
}

} // namespace

void bind_shape_queries(py::module_& module) {
    bind_shape_results(module);
    bind_point_and_ray_verbs(module);
    bind_shape_verbs(module);
    add_overload(
        "nearest",
        {a_model, {"model pose points * upper_bound signed_distance progress", 3}, run_nearest});
    add_overload("contains", {a_model, {"model pose points * progress", 3}, run_contains});
    add_overload(
        "first_hit",
        {a_model, {"model pose origin direction t_min t_max * progress", 3}, run_first_hit});
    add_overload(
        "all_hits",
        {a_model, {"model pose origin direction t_min t_max * progress", 3}, run_all_hits});
    add_overload("overlaps", {model_and_shape, {"model pose shape * progress", 3}, run_overlaps});
    add_overload("overlaps",
                 {a_model, {"model pose lower upper * progress", 4}, run_boxes_overlap});
    add_overload("overlapping_triangles",
                 {a_model, {"model pose shape * progress", 3}, run_overlapping_triangles});
    add_overload(
        "distance",
        {model_and_segment,
         {"model pose segment * upper_bound absolute_error relative_error max_steps progress", 3},
         run_segment_distance});
}

} // namespace abut::python
