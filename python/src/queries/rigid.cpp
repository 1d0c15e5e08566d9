#include <abut/batch.h>
#include <abut/model.h>
#include <abut/rigid.h>

#include "module.h"
#include "queries/queries.h"
#include "support/warm.h"

namespace abut::python {

namespace {

py::object run_collide(const Arguments& arguments) {
    const Model& a = get<Model>(arguments[0], "a");
    const Model& b = get<Model>(arguments[2], "b");
    const PosePair poses(arguments, 1, 3);
    CollideOptions options;
    arguments.take(4, "mode", options.mode);
    arguments.take(5, "segments", options.segments);
    const WarmArgument<WarmStart> warm(arguments, 6);
    options.warm_start = warm.get();
    Work work(arguments[7]);
    if (poses.many()) {
        const auto placements = poses.placements();
        return contacts_of(work.run([&](const Progress& progress) {
            options.progress = progress;
            return collide(a, b, placements, options);
        }));
    }
    return py::cast(work.run([&](const Progress& progress) {
        options.progress = progress;
        return collide(a, poses.a.one, b, poses.b.one, options);
    }));
}

DistanceOptions distance_options(const Arguments& arguments, std::size_t first) {
    DistanceOptions options;
    arguments.take(first, "upper_bound", options.upper_bound);
    arguments.take(first + 1, "absolute_error", options.absolute_error);
    arguments.take(first + 2, "relative_error", options.relative_error);
    arguments.take(first + 3, "signed_distance", options.signed_distance);
    arguments.take(first + 4, "max_steps", options.max_steps);
    return options;
}

py::object run_distance(const Arguments& arguments) {
    const Model& a = get<Model>(arguments[0], "a");
    const Model& b = get<Model>(arguments[2], "b");
    const PosePair poses(arguments, 1, 3);
    DistanceOptions options = distance_options(arguments, 4);
    const WarmArgument<WarmStart> warm(arguments, 9);
    options.warm_start = warm.get();
    Work work(arguments[10]);
    if (poses.many()) {
        const auto placements = poses.placements();
        return records(work.run([&](const Progress& progress) {
            options.progress = progress;
            return distance(a, b, placements, options);
        }));
    }
    return py::cast(work.run([&](const Progress& progress) {
        options.progress = progress;
        return distance(a, poses.a.one, b, poses.b.one, options);
    }));
}

py::object run_within(const Arguments& arguments) {
    const Model& a = get<Model>(arguments[0], "a");
    const Model& b = get<Model>(arguments[2], "b");
    const PosePair poses(arguments, 1, 3);
    const double tolerance = to_double(arguments[4], "tolerance");
    WithinOptions options;
    const WarmArgument<WarmStart> warm(arguments, 5);
    options.warm_start = warm.get();
    Work work(arguments[6]);
    if (poses.many()) {
        const auto placements = poses.placements();
        return booleans(work.run([&](const Progress& progress) {
            options.progress = progress;
            return within(a, b, placements, tolerance, options);
        }));
    }
    return py::bool_(work.run([&](const Progress& progress) {
        options.progress = progress;
        return within(a, poses.a.one, b, poses.b.one, tolerance, options);
    }));
}

constexpr const char* kCollide =
    "collide(a, pose_a, b, pose_b, *, mode='first', segments=False, warm_start=None, "
    "progress=None)\n--\n\n"
    "The pairs of triangles that share a point. Touching counts; a model inside another does not "
    "collide.\n\n"
    "a, b            two Model, or two ConvexPieces\n"
    "pose_a, pose_b  None, a matrix of shape (4, 4), (translation, quaternion) or a Pose; or many: "
    "an array of\n"
    "                shape (n, 4, 4). One pose of a model is used with all of the other's\n"
    "mode            'first': stop at the first pair. 'all': every pair\n"
    "segments        whether Contacts.segments tells where each pair meets (models only)\n"
    "triangles       whether PiecesContacts.triangles is filled (ConvexPieces only)\n"
    "warm_start      a WarmStart or PiecesWarmStart, for a first contact; not with many poses\n"
    "progress        function of (stage, fraction)\n\n"
    "Returns Contacts (PiecesContacts); with many poses ContactsList (a list of PiecesContacts), "
    "computed in\n"
    "parallel. Exact. Raises Error (bad_argument) if a pose is not finite; KeyboardInterrupt at "
    "Ctrl-C.";

constexpr const char* kDistance =
    "distance(a, pose_a, b, pose_b, *, upper_bound=inf, absolute_error=0, relative_error=0,\n"
    "         signed_distance=False, max_steps=None, warm_start=None, progress=None)\n"
    "distance(model, pose, segment, ...)\n\n"
    "The distance of two surfaces, or of two convex bodies or solids, and a pair of closest "
    "points.\n\n"
    "a, b             two Model, two Convex or two ConvexPieces\n"
    "segment          a Segment in the world frame\n"
    "pose_a, pose_b   as for collide\n"
    "upper_bound      length; greater distances are not computed (not for Convex)\n"
    "absolute_error   length by which the distance may exceed the true one\n"
    "relative_error   share of the result by which it may (models only)\n"
    "signed_distance  minus the depth where models go into each other (models only)\n"
    "max_steps        limit of the search (models only)\n"
    "warm_start       a WarmStart, ConvexWarmStart or PiecesWarmStart; not with many poses\n"
    "progress         function of (stage, fraction)\n\n"
    "Returns Gap, ConvexGap or PiecesGap; with many poses a record array of shape (n,) with their "
    "fields,\n"
    "computed in parallel (Convex: one after another). Lengths are those of the vertices. Accurate "
    "to double\n"
    "rounding, and 0 exactly if they meet. Raises Error (bad_argument) if a pose is not finite or "
    "a bound is\n"
    "negative; KeyboardInterrupt at Ctrl-C.";

constexpr const char* kWithin =
    "within(a, pose_a, b, pose_b, tolerance, *, warm_start=None, progress=None)\n"
    "within(surface_a, surface_b, distance, *, at_end=False, vertices=None, vertices_b=None, "
    "progress=None)\n"
    "within(surface, body, pose, distance, *, at_end=False, vertices=None, progress=None)\n\n"
    "Whether some two points are at most `tolerance` apart, a length.\n\n"
    "a, b            two Model or two ConvexPieces\n"
    "pose_a, pose_b  as for collide\n"
    "surface_a, _b   two Deformable: lists all near pairs of features, as self_within\n"
    "surface, body   a Deformable and a rigid shape (Model, Convex, Sphere, Capsule, Box3, "
    "Cylinder, "
    "Cone,\n"
    "                Ellipsoid, HalfSpace): lists the parts of the surface that are near it or in "
    "it\n"
    "at_end          take the positions at the end of the step\n"
    "vertices        NearVertices of the (first) surface; vertices_b: of the second\n\n"
    "Returns a bool; with many poses an array of bool of shape (n,). Of two deformables a record "
    "array of\n"
    "FeaturePair, of a deformable and a body one of SurfaceContact.\n"
    "Raises Error (bad_argument) if the tolerance is negative; KeyboardInterrupt at Ctrl-C.";

bool two_models(PyObject* first, PyObject* third) {
    return both<Model>(first, third);
}

void bind_warm_start(py::module_& module) {
    py::class_<Warm<WarmStart>>(
        module, "WarmStart",
        "WarmStart()\n\nRemembers where two models met or were closest, for the next pose.\n"
        "Use one for each pair of models. Answers do not depend on it, but for which of several\n"
        "closest pairs is found.")
        .def(py::init<>())
        .def_property_readonly("used", [](const Warm<WarmStart>& warm) { return warm.value.used; })
        .def_property_readonly(
            "last",
            [](const Warm<WarmStart>& warm) {
                return py::make_tuple(warm.value.last.a, warm.value.last.b);
            },
            "the two triangles")
        .def("__repr__", [](const Warm<WarmStart>& warm) {
            return warm.value.used ? "WarmStart(last=(" + std::to_string(warm.value.last.a) + ", " +
                                         std::to_string(warm.value.last.b) + "))"
                                   : std::string("WarmStart()");
        });

    RecordBinder<Intersection>(module, "Intersection", "The points that two triangles share.")
        .field("count", &Intersection::count, "corners: 1 a point, 2 a segment, 3 to 6 a polygon")
        .done();
}

void bind_pair_results(py::module_& module) {
    PlainBinder<Contacts>(module, "Contacts", "Returned by collide. True if the models meet.")
        .property(
            "meet", [](const Contacts& c) { return c.meet(); },
            "whether the surfaces share a point")
        .property(
            "pairs", [](const Contacts& c) { return rows<std::uint32_t>(c.pairs); },
            "uint32 array of shape (n, 2): triangles of a and of b, sorted")
        .property(
            "segments", [](const Contacts& c) { return intersections(c.segments); },
            "list of arrays of shape (1 to 6, 3), one for each pair, if asked for")
        .field("status", &Contacts::status, "Status")
        .field("counters", &Contacts::counters, "Counters")
        .done()
        .def("__bool__", [](const Contacts& c) { return c.meet(); });

    RecordBinder<Gap>(module, "Gap", "Returned by distance.")
        .field("distance", &Gap::distance, "length; 0 if the surfaces meet")
        .field("at_least", &Gap::at_least, "proven: no two points are closer")
        .field("point_a", &Gap::point_a, "closest point of a, world frame")
        .field("point_b", &Gap::point_b, "closest point of b, world frame")
        .field("triangle_a", &Gap::triangle_a, "triangle of a with the point")
        .field("triangle_b", &Gap::triangle_b, "triangle of b with the point")
        .field("feature_a", &Gap::feature_a, "Feature of the triangle that the point lies on")
        .field("feature_b", &Gap::feature_b, "Feature of the triangle that the point lies on")
        .field("index_a", &Gap::index_a, "which vertex or edge of the triangle")
        .field("index_b", &Gap::index_b, "which vertex or edge of the triangle")
        .field("status", &Gap::status,
               "Status; bound_only: nothing nearer than upper_bound, or out of steps")
        .field("out_of_steps", &Gap::out_of_steps, "whether max_steps ended the search")
        .field("steps", &Gap::steps, "steps of the search")
        .field("counters", &Gap::counters, "Counters")
        .done();
}

} // namespace

void bind_rigid(py::module_& module) {
    bind_enum<ContactMode>(module, "ContactMode", {"first", "all"},
                           "Whether to stop at the first pair.");
    RecordBinder<Counters>(module, "Counters",
                           "The work that a query did, the same on every machine.")
        .field("volume", &Counters::volume,
               "Volume that was tested; models of different kinds: see common_volume")
        .field("volume_tests", &Counters::volume_tests, "pairs of bounding volumes")
        .field("primitive_tests", &Counters::primitive_tests, "pairs of triangles")
        .field("exact_tests", &Counters::exact_tests,
               "signs that only exact arithmetic could decide")
        .done();
    bind_warm_start(module);
    bind_pair_results(module);
    add_verb(module, "collide", kCollide);
    add_verb(module, "distance", kDistance);
    add_verb(module, "within", kWithin);
    add_overload(
        "collide",
        {two_models, {"a pose_a b pose_b * mode segments warm_start progress", 4}, run_collide});
    add_overload(
        "distance",
        {two_models,
         {"a pose_a b pose_b * upper_bound absolute_error relative_error signed_distance max_steps "
          "warm_start progress",
          4},
         run_distance});
    add_overload(
        "within",
        {two_models, {"a pose_a b pose_b tolerance * warm_start progress", 5}, run_within});
    bind_batch(module);
}

} // namespace abut::python
