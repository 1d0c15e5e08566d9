#include <abut/batch.h>
#include <abut/convex_pieces.h>

#include "module.h"
#include "queries/queries.h"
#include "support/meshes.h"
#include "support/warm.h"

namespace abut::python {

namespace {

const ConvexPieces& pieces(const Arguments& arguments, std::size_t place, const char* name) {
    return get<ConvexPieces>(arguments[place], name);
}

/// Runs one query or many: `one(progress)` or `all(progress, placements)`.
template <class One, class All>
py::object run_pieces(const PosePair& poses, py::handle report, One one, All all) {
    Work work(report);
    if (!poses.many())
        return py::cast(work.run(one));
    const auto placements = poses.placements();
    auto answers = work.run([&](const Progress& progress) { return all(progress, placements); });
    using Answer = typename decltype(answers)::value_type;
    if constexpr (std::is_same_v<Answer, bool>)
        return booleans(answers);
    else if constexpr (std::is_trivially_copyable_v<Answer>)
        return records(std::move(answers));
    else
        return py::cast(std::move(answers));
}

py::object run_pieces_collide(const Arguments& arguments) {
    const auto& a = pieces(arguments, 0, "a");
    const auto& b = pieces(arguments, 2, "b");
    const PosePair poses(arguments, 1, 3);
    PiecesCollideOptions options;
    arguments.take(4, "mode", options.mode);
    arguments.take(5, "triangles", options.triangles);
    const WarmArgument<PiecesWarmStart> warm(arguments, 6);
    options.warm_start = warm.get();
    return run_pieces(
        poses, arguments[7],
        [&](const Progress& progress) {
            options.progress = progress;
            return collide(a, poses.a.one, b, poses.b.one, options);
        },
        [&](const Progress& progress, const std::vector<Placement>& placements) {
            options.progress = progress;
            return collide(a, b, placements, options);
        });
}

py::object run_pieces_distance(const Arguments& arguments) {
    const auto& a = pieces(arguments, 0, "a");
    const auto& b = pieces(arguments, 2, "b");
    const PosePair poses(arguments, 1, 3);
    PiecesDistanceOptions options;
    arguments.take(4, "upper_bound", options.upper_bound);
    arguments.take(5, "absolute_error", options.absolute_error);
    const WarmArgument<PiecesWarmStart> warm(arguments, 6);
    options.warm_start = warm.get();
    return run_pieces(
        poses, arguments[7],
        [&](const Progress& progress) {
            options.progress = progress;
            return distance(a, poses.a.one, b, poses.b.one, options);
        },
        [&](const Progress& progress, const std::vector<Placement>& placements) {
            options.progress = progress;
            return distance(a, b, placements, options);
        });
}

py::object run_pieces_within(const Arguments& arguments) {
    const auto& a = pieces(arguments, 0, "a");
    const auto& b = pieces(arguments, 2, "b");
    const PosePair poses(arguments, 1, 3);
    const double tolerance = to_double(arguments[4], "tolerance");
    PiecesWithinOptions options;
    const WarmArgument<PiecesWarmStart> warm(arguments, 5);
    options.warm_start = warm.get();
    return run_pieces(
        poses, arguments[6],
        [&](const Progress& progress) {
            options.progress = progress;
            return within(a, poses.a.one, b, poses.b.one, tolerance, options);
        },
        [&](const Progress& progress, const std::vector<Placement>& placements) {
            options.progress = progress;
            return within(a, b, placements, tolerance, options);
        });
}

py::object run_pieces_penetration(const Arguments& arguments) {
    const auto& a = pieces(arguments, 0, "a");
    const auto& b = pieces(arguments, 2, "b");
    const PosePair poses(arguments, 1, 3);
    PiecesPenetrationOptions options;
    arguments.take(4, "separation", options.separation);
    return run_pieces(
        poses, arguments[5],
        [&](const Progress& progress) {
            options.progress = progress;
            return penetration(a, poses.a.one, b, poses.b.one, options);
        },
        [&](const Progress& progress, const std::vector<Placement>& placements) {
            options.progress = progress;
            return penetration(a, b, placements, options);
        });
}

void bind_pieces_class(py::module_& module) {
    const auto piece_of = [](const ConvexPieces& self, std::size_t piece) {
        if (piece >= self.size())
            throw py::index_error();
        return piece;
    };
    py::class_<ConvexPieces>(
        module, "ConvexPieces",
        "ConvexPieces(model)\n\n"
        "A closed model as a solid, decomposed into convex pieces. It never changes; any number of "
        "threads\n"
        "may query it. Takes what Model takes.\n\n"
        "Raises Error (bad_mesh) if the mesh is not closed, or turned inside out.")
        .def(py::init([](const py::object& source, const py::object& faces) {
                 if (const auto* model = peek<Model>(source)) {
                     const Model copy = *model;
                     const py::gil_scoped_release unlocked;
                     return ConvexPieces(copy);
                 }
                 Mesh mesh = to_mesh_value(source, faces);
                 const py::gil_scoped_release unlocked;
                 return ConvexPieces(Model(std::move(mesh)));
             }),
             py::arg("model"), py::arg("faces") = py::none())
        .def("__len__", &ConvexPieces::size)
        .def_property_readonly("size", &ConvexPieces::size, "number of pieces")
        .def(
            "triangles",
            [piece_of](const ConvexPieces& self, std::size_t piece) {
                const auto list = self.triangles(piece_of(self, piece));
                return numbers(std::vector<std::uint32_t>(list.begin(), list.end()));
            },
            py::arg("piece"), "The triangles of a piece, a uint32 array of shape (n,).")
        .def(
            "hull",
            [piece_of](const ConvexPieces& self, std::size_t piece) {
                return self.hull(piece_of(self, piece));
            },
            py::arg("piece"), "The hull of a piece, a Convex.")
        .def_property_readonly("model", [](const ConvexPieces& self) { return self.model(); })
        .def_property_readonly("bytes", &ConvexPieces::bytes)
        .def("__repr__", [](const ConvexPieces& self) {
            return "<abut.ConvexPieces: " + std::to_string(self.size()) + " pieces>";
        });
}

void bind_pieces_results(py::module_& module) {
    py::class_<Warm<PiecesWarmStart>>(
        module, "PiecesWarmStart",
        "PiecesWarmStart()\n\nRemembers the closest pieces of two solids for the next pose.")
        .def(py::init<>());
    RecordBinder<PiecesCounters>(module, "PiecesCounters", "The work that a query did.")
        .field("hull_pairs", &PiecesCounters::hull_pairs, "pairs of hulls that were measured")
        .field("directions", &PiecesCounters::directions,
               "pairs of hulls compared along one direction")
        .field("sphere_pairs", &PiecesCounters::sphere_pairs, "pairs of spheres around them")
        .field("feature_pairs", &PiecesCounters::feature_pairs,
               "pairs of features that were measured")
        .field("simplices", &PiecesCounters::simplices, "steps of the search that takes over")
        .done();
    RecordBinder<PiecesGap>(module, "PiecesGap", "Returned by distance of two ConvexPieces.")
        .field("distance", &PiecesGap::distance, "length; 0 if the solids share a point")
        .field("at_least", &PiecesGap::at_least, "proven: no two points are closer")
        .field("point_a", &PiecesGap::point_a, "world frame")
        .field("point_b", &PiecesGap::point_b, "world frame")
        .field("piece_a", &PiecesGap::piece_a, "piece of a")
        .field("piece_b", &PiecesGap::piece_b, "piece of b")
        .field("triangle_a", &PiecesGap::triangle_a, "triangle of a's model")
        .field("triangle_b", &PiecesGap::triangle_b, "triangle of b's model")
        .field("feature_a", &PiecesGap::feature_a, "Feature of the triangle")
        .field("feature_b", &PiecesGap::feature_b, "Feature of the triangle")
        .field("index_a", &PiecesGap::index_a, "which vertex or edge")
        .field("index_b", &PiecesGap::index_b, "which vertex or edge")
        .field("status", &PiecesGap::status, "Status")
        .field("counters", &PiecesGap::counters, "PiecesCounters")
        .done();
    PlainBinder<PiecesContacts>(module, "PiecesContacts",
                                "Returned by collide of two ConvexPieces.")
        .field("meet", &PiecesContacts::meet, "the solids share a point")
        .field("contained", &PiecesContacts::contained,
               "one lies inside the other and no pieces meet")
        .property(
            "pairs", [](const PiecesContacts& c) { return rows<std::uint32_t>(c.pairs); },
            "uint32 array of shape (n, 2): pieces that meet, to rounding")
        .property(
            "triangles", [](const PiecesContacts& c) { return rows<std::uint32_t>(c.triangles); },
            "uint32 array of shape (n, 2), if asked for")
        .field("counters", &PiecesContacts::counters, "PiecesCounters")
        .done()
        .def("__bool__", [](const PiecesContacts& c) { return c.meet; });
    auto depth = RecordBinder<PiecesDepth>(module, "PiecesDepth",
                                           "Returned by penetration of two ConvexPieces.");
    depth.field("meet", &PiecesDepth::meet, "they share a point")
        .field("depth", &PiecesDepth::depth, "proven: no shorter translation separates them")
        .field("direction", &PiecesDepth::direction,
               "unit vector in which b moves by `depth` to part the two pieces")
        .field("point_a", &PiecesDepth::point_a, "world frame")
        .field("point_b", &PiecesDepth::point_b, "world frame")
        .field("piece_a", &PiecesDepth::piece_a, "piece of a")
        .field("piece_b", &PiecesDepth::piece_b, "piece of b")
        .field("separation", &PiecesDepth::separation,
               "translation of b after which the solids are apart: verified")
        .field("status", &PiecesDepth::status, "Status")
        .field("counters", &PiecesDepth::counters, "PiecesCounters");
    depth.done().def("__bool__", [](const PiecesDepth& self) { return self.meet; });
}

} // namespace

void bind_convex_pieces(py::module_& module) {
    bind_pieces_class(module);
    bind_pieces_results(module);
    add_overload("collide", {both<ConvexPieces>,
                             {"a pose_a b pose_b * mode triangles warm_start progress", 4},
                             run_pieces_collide});
    add_overload("distance",
                 {both<ConvexPieces>,
                  {"a pose_a b pose_b * upper_bound absolute_error warm_start progress", 4},
                  run_pieces_distance});
    add_overload("within", {both<ConvexPieces>,
                            {"a pose_a b pose_b tolerance * warm_start progress", 5},
                            run_pieces_within});
    add_overload("penetration", {both<ConvexPieces>,
                                 {"a pose_a b pose_b * separation progress", 4},
                                 run_pieces_penetration});
}

} // namespace abut::python
