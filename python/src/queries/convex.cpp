#include <abut/convex.h>

#include "module.h"
#include "queries/queries.h"
#include "support/meshes.h"
#include "support/warm.h"

namespace abut::python {

namespace {

/// Points alone give their hull; anything else must be a mesh that is convex.
Convex make_convex(const py::object& source, const py::object& faces, double relative_dent) {
    const bool points = faces.is_none() && (is_array(source) || PyList_Check(source.ptr()) ||
                                            PyTuple_Check(source.ptr()));
    if (points) {
        const auto list = to_points(source, "points");
        const py::gil_scoped_release unlocked;
        return Convex(list);
    }
    const Mesh mesh = to_mesh_value(source, faces);
    const py::gil_scoped_release unlocked;
    return Convex(mesh, ConvexOptions{.relative_dent = relative_dent});
}

/// One query or many, one after another.
template <class Query>
py::object one_or_many(const PosePair& poses, Work& work, Query query) {
    if (!poses.many())
        return py::cast(work.run(
            [&](const Progress& /*progress*/) { return query(poses.a.one, poses.b.one); }));
    const auto placements = poses.placements();
    return records(work.run([&](const Progress& progress) {
        std::vector<decltype(query(poses.a.one, poses.b.one))> answers;
        answers.reserve(placements.size());
        for (const Placement& placement : placements) {
            if (*progress.stop)
                throw Error(ErrorCode::interrupted, "interrupted");
            answers.push_back(query(placement.world_from_a, placement.world_from_b));
        }
        return answers;
    }));
}

py::object run_convex_distance(const Arguments& arguments) {
    const auto& a = get<Convex>(arguments[0], "a");
    const auto& b = get<Convex>(arguments[2], "b");
    const PosePair poses(arguments, 1, 3);
    ConvexDistanceOptions options;
    arguments.take(4, "absolute_error", options.absolute_error);
    const WarmArgument<ConvexWarmStart> warm(arguments, 5);
    options.warm_start = warm.get();
    Work work;
    return one_or_many(poses, work, [&](const Transform& wa, const Transform& wb) {
        return distance(a, wa, b, wb, options);
    });
}

py::object run_convex_penetration(const Arguments& arguments) {
    const auto& a = get<Convex>(arguments[0], "a");
    const auto& b = get<Convex>(arguments[2], "b");
    const PosePair poses(arguments, 1, 3);
    const WarmArgument<ConvexWarmStart> warm(arguments, 4);
    const ConvexPenetrationOptions options{.warm_start = warm.get()};
    Work work;
    return one_or_many(poses, work, [&](const Transform& wa, const Transform& wb) {
        return penetration(a, wa, b, wb, options);
    });
}

py::class_<Convex> convex_class(py::module_& module) {
    return py::class_<Convex>(
               module, "Convex",
               "Convex(points)\nConvex(vertices, faces, *, relative_dent=1e-6)\nConvex(mesh)\n\n"
               "A solid convex body: the hull of points of shape (n, 3), or a mesh that is convex "
               "already. It never\n"
               "changes; any number of threads may query it.\n\n"
               "relative_dent  how deep a dent of a mesh is taken for rounding, as a share of its "
               "diagonal\n\n"
               "Raises Error (bad_mesh) if there is no point, a coordinate is not finite, or the "
               "mesh is "
               "not closed\n"
               "or not convex.")
        .def(py::init(&make_convex), py::arg("points"), py::arg("faces") = py::none(),
             py::kw_only(), py::arg("relative_dent") = 1e-6)
        .def_property_readonly(
            "vertices",
            [](const py::object& self) {
                const auto& list = self.cast<const Convex&>().vertices();
                return view_rows<double>(list.data(), list.size(), self);
            },
            "float64 array of shape (n, 3)")
        .def_property_readonly(
            "edges",
            [](const py::object& self) {
                const auto& list = self.cast<const Convex&>().edges();
                return view_rows<std::uint32_t>(list.data(), list.size(), self);
            },
            "uint32 array of shape (n, 2)")
        .def_property_readonly(
            "faces",
            [](const Convex& convex) {
                py::list list;
                for (std::size_t i = 0; i < convex.face_count(); ++i) {
                    const auto face = convex.face(i);
                    list.append(numbers(std::vector<std::uint32_t>(face.begin(), face.end())));
                }
                return list;
            },
            "list of arrays: the vertices of each face, counter-clockwise as seen from outside")
        .def_property_readonly(
            "source", [](const Convex& convex) { return numbers(convex.source()); },
            "uint32 array of shape (n,): which of the points given each vertex is");
}

void add_convex_properties(py::class_<Convex>& type) {
    type.def_property_readonly("dimension", &Convex::dimension,
                               "3, or 2 for a polygon, 1 for a segment, 0 for a point")
        .def("mesh", &Convex::mesh, "The surface in triangles, a Mesh.")
        .def_property_readonly("bytes", &Convex::bytes)
        .def(
            py::pickle([](const py::object& self) { return py::make_tuple(self.attr("vertices")); },
                       [](const py::tuple& state) { return make_convex(state[0], py::none(), 0); }))
        .def("__repr__", [](const Convex& convex) {
            return "<abut.Convex: " + std::to_string(convex.vertices().size()) + " vertices, " +
                   std::to_string(convex.face_count()) + " faces>";
        });
}

} // namespace

void bind_convex(py::module_& module) {
    auto convex = convex_class(module);
    add_convex_properties(convex);
    py::class_<Warm<ConvexWarmStart>>(module, "ConvexWarmStart",
                                      "ConvexWarmStart()\n\nRemembers the closest features of two "
                                      "convex bodies for the next pose.")
        .def(py::init<>());
    RecordBinder<ConvexCounters>(module, "ConvexCounters", "The work that a query did.")
        .field("feature_pairs", &ConvexCounters::feature_pairs,
               "pairs of features that were measured")
        .field("simplices", &ConvexCounters::simplices, "steps of the search that takes over")
        .done();
    RecordBinder<ConvexGap>(module, "ConvexGap", "Returned by distance of two Convex.")
        .field("distance", &ConvexGap::distance, "length; 0 exactly if they share a point")
        .field("at_least", &ConvexGap::at_least, "proven: no two points are closer")
        .field("point_a", &ConvexGap::point_a, "world frame")
        .field("point_b", &ConvexGap::point_b, "world frame")
        .field("feature_a", &ConvexGap::feature_a, "Feature that the point lies on")
        .field("feature_b", &ConvexGap::feature_b, "Feature that the point lies on")
        .field("id_a", &ConvexGap::id_a, "number of that vertex, edge or face")
        .field("id_b", &ConvexGap::id_b, "number of that vertex, edge or face")
        .field("status", &ConvexGap::status, "Status")
        .field("counters", &ConvexGap::counters, "ConvexCounters")
        .done();
    auto depth =
        RecordBinder<ConvexDepth>(module, "ConvexDepth", "Returned by penetration of two Convex.");
    depth.field("meet", &ConvexDepth::meet, "they share a point")
        .field("depth", &ConvexDepth::depth,
               "length of the shortest translation that leaves them touching")
        .field("at_least", &ConvexDepth::at_least, "proven: no shorter one does")
        .field("direction", &ConvexDepth::direction, "unit vector in which b moves by `depth`")
        .field("point_a", &ConvexDepth::point_a, "on the surface, world frame")
        .field("point_b", &ConvexDepth::point_b, "on the surface, world frame")
        .field("status", &ConvexDepth::status, "Status")
        .field("counters", &ConvexDepth::counters, "ConvexCounters");
    depth.done().def("__bool__", [](const ConvexDepth& self) { return self.meet; });
    add_overload(
        "distance",
        {both<Convex>, {"a pose_a b pose_b * absolute_error warm_start", 4}, run_convex_distance});
    add_overload("penetration",
                 {both<Convex>, {"a pose_a b pose_b * warm_start", 4}, run_convex_penetration});
}

} // namespace abut::python
