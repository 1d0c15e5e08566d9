#include <abut/constraint_colours.h>
#include <abut/surface_contacts.h>

#include "bodies/bodies.h"
#include "bodies/surface.h"
#include "support/arrays.h"
#include "support/records.h"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace abut::python {

namespace {

/// A NearVertices that owns its arrays.
struct KeptNearVertices {
    std::vector<double> thickness;
    std::vector<std::uint32_t> groups, masks;
    std::vector<std::uint8_t> moved;

    [[nodiscard]] NearVertices view() const { return {thickness, groups, masks, moved}; }
};

/// An array of numbers or booleans of shape (n,); None is an empty one.
template <class Number>
std::vector<Number> to_numbers(const py::object& object, const char* name, const char* kinds) {
    if (object.is_none())
        return {};
    const auto source = py::array::ensure(object);
    if (!source || (source.size() != 0 &&
                    std::string(kinds).find(source.dtype().kind()) == std::string::npos)) {
        PyErr_Clear();
        throw py::type_error(std::string(name) + ": an array of numbers is wanted");
    }
    if (source.ndim() != 1)
        throw py::value_error(std::string(name) + ": an array of shape (n,) is wanted");
    const py::array_t<Number, py::array::c_style | py::array::forcecast> list(source);
    // Not in braces, which would make a list of two booleans.
    return std::vector<Number>(list.data(), list.data() + list.size());
}

KeptNearVertices near_vertices(const py::object& thickness, const py::object& groups,
                               const py::object& masks, const py::object& moved) {
    KeptNearVertices kept;
    kept.thickness = to_numbers<double>(thickness, "thickness", "fiu");
    if (!groups.is_none())
        kept.groups = to_indices(groups, "groups");
    if (!masks.is_none())
        kept.masks = to_indices(masks, "masks");
    // Any number that is not 0.
    for (const bool each : to_numbers<bool>(moved, "moved", "biuf"))
        kept.moved.push_back(each ? 1 : 0);
    return kept;
}

/// The options of a query.
///
/// In: numbers of the arguments at_end and vertices; that of vertices_b, if the query has it.
NearOptions near_options(const Arguments& arguments, std::size_t at_end, std::size_t vertices,
                         std::size_t vertices_b = Arguments::kMost) {
    NearOptions options;
    arguments.take(at_end, "at_end", options.at_end);
    if (arguments.has(vertices))
        options.vertices = get<KeptNearVertices>(arguments[vertices], "vertices").view();
    if (vertices_b < Arguments::kMost && arguments.has(vertices_b))
        options.vertices_b = get<KeptNearVertices>(arguments[vertices_b], "vertices_b").view();
    return options;
}

py::object run_self_within(const Arguments& arguments) {
    const double distance = to_double(arguments[1], "distance");
    NearOptions options = near_options(arguments, 2, 3);
    return records(read_one(arguments, 4, [&](const Deformable& surface, const Progress& progress) {
        options.progress = progress;
        return self_within(surface, distance, options);
    }));
}

/// A surface and a rigid body. In: the last three are numbers of arguments.
py::object run_body_within(const Arguments& arguments, NearOptions options, std::size_t pose,
                           std::size_t distance, std::size_t report) {
    const double length = to_double(arguments[distance], "distance");
    const Pose place = to_pose(arguments[pose], "pose");
    const RigidShape body = with_rigid_shape(py::reinterpret_borrow<py::object>(arguments[1]),
                                             "HalfSpace or Deformable",
                                             [](const auto& rigid) { return RigidShape(rigid); });
    return records(
        read_one(arguments, report, [&](const Deformable& surface, const Progress& progress) {
            options.progress = progress;
            return within(surface, body, place, length, options);
        }));
}
/// "surface body pose distance * at_end vertices progress"
py::object run_placed_body_within(const Arguments& arguments) {
    return run_body_within(arguments, near_options(arguments, 4, 5), 2, 3, 6);
}
/// "a b distance * at_end vertices vertices_b progress pose": two surfaces, or a body whose pose is
/// not given or is given by name.
py::object run_surfaces_within(const Arguments& arguments) {
    NearOptions options = near_options(arguments, 3, 4, 5);
    if (!peek<Surface>(arguments[1]))
        return run_body_within(arguments, options, 7, 2, 6);
    if (arguments.has(7))
        throw py::type_error("within() of two surfaces has no pose");
    const double distance = to_double(arguments[2], "distance");
    return records(read_two(
        arguments, 6, [&](const Deformable& a, const Deformable& b, const Progress& progress) {
            options.progress = progress;
            return within(a, b, distance, options);
        }));
}

bool a_surface_and_a_length(PyObject* first, PyObject* third) {
    return is_a<Surface>(first) &&
           (third == nullptr || (PyNumber_Check(third) && !PySequence_Check(third)));
}

template <std::size_t N>
ConstraintColours colours_of(const py::array_t<std::int64_t>& vertices,
                             const std::vector<std::uint8_t>& fixed) {
    std::vector<std::array<std::uint32_t, N>> list(static_cast<std::size_t>(vertices.shape(0)));
    const auto values = vertices.unchecked<2>();
    for (std::size_t i = 0; i < list.size(); ++i)
        for (std::size_t k = 0; k < N; ++k) {
            const std::int64_t v = values(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k));
            if (v < 0 || v > 0xffffffff)
                throw py::value_error("constraints: " + std::to_string(v) + " is no vertex");
            list[i][k] = static_cast<std::uint32_t>(v);
        }
    const py::gil_scoped_release unlocked;
    return colour_constraints(list, fixed);
}

ConstraintColours colour(const py::object& constraints, const py::object& fixed) {
    const auto given = py::array::ensure(constraints);
    if (!given ||
        (given.size() != 0 && given.dtype().kind() != 'i' && given.dtype().kind() != 'u')) {
        PyErr_Clear();
        throw py::type_error("constraints: an array of integers is wanted");
    }
    std::vector<std::uint8_t> fixed_vertices;
    for (const bool each : to_numbers<bool>(fixed, "fixed", "biuf"))
        fixed_vertices.push_back(each ? 1 : 0);
    const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> wide(given);
    if (wide.ndim() == 2 && wide.shape(1) == 2)
        return colours_of<2>(wide, fixed_vertices);
    if (wide.ndim() == 2 && wide.shape(1) == 3)
        return colours_of<3>(wide, fixed_vertices);
    if (wide.ndim() == 2 && wide.shape(1) == 4)
        return colours_of<4>(wide, fixed_vertices);
    throw py::value_error("constraints: an array of shape (n, 2), (n, 3) or (n, 4) is wanted");
}

void bind_near_vertices(py::module_& module) {
    py::class_<KeptNearVertices>(
        module, "NearVertices",
        "NearVertices(thickness=None, groups=None, masks=None, moved=None)\n\n"
        "What a query of near features knows of the vertices of a surface: arrays with an entry "
        "for "
        "each vertex.\n\n"
        "thickness  lengths; a feature is as thick as the thickest of its vertices. None: 0\n"
        "groups     bit sets; a feature belongs to every group that one of its vertices belongs "
        "to. None: 1\n"
        "masks      bit sets; a feature meets the groups that all its vertices meet. None: all\n"
        "moved      true for vertices that have moved: only pairs with such a vertex are listed. "
        "None: all pairs")
        .def(py::init(&near_vertices), py::arg("thickness") = py::none(),
             py::arg("groups") = py::none(), py::arg("masks") = py::none(),
             py::arg("moved") = py::none())
        .def_property_readonly(
            "thickness", [](const KeptNearVertices& self) { return numbers(self.thickness); },
            "float64 array; empty: 0")
        .def_property_readonly(
            "groups", [](const KeptNearVertices& self) { return numbers(self.groups); },
            "uint32 array; empty: 1")
        .def_property_readonly(
            "masks", [](const KeptNearVertices& self) { return numbers(self.masks); },
            "uint32 array; empty: all")
        .def_property_readonly(
            "moved",
            [](const KeptNearVertices& self) {
                return booleans(std::vector<bool>(self.moved.begin(), self.moved.end()));
            },
            "bool array; empty: all pairs");
}

void bind_colours(py::module_& module) {
    py::class_<ConstraintColours>(
        module, "ConstraintColours",
        "Constraints in groups of which no two share a vertex. Returned by "
        "colour_constraints.")
        .def_property_readonly(
            "order", [](const ConstraintColours& self) { return numbers(self.order); },
            "uint32 array: the constraints of the first colour, then those of the second, ...")
        .def_property_readonly(
            "begins", [](const ConstraintColours& self) { return numbers(self.begins); },
            "uint32 array: where each colour begins in `order`, and its length")
        .def("count", &ConstraintColours::count, "The number of colours.")
        .def(
            "of",
            [](const ConstraintColours& self, std::size_t colour) {
                if (colour >= self.count())
                    throw py::index_error("colour: there are " + std::to_string(self.count()));
                const auto list = self.of(colour);
                return numbers(std::vector<std::uint32_t>(list.begin(), list.end()));
            },
            py::arg("colour"), "The constraints of a colour: a uint32 array.")
        .def("__len__", &ConstraintColours::count)
        .def("__repr__", [](const ConstraintColours& self) {
            return "<abut.ConstraintColours: " + std::to_string(self.order.size()) +
                   " constraints in " + std::to_string(self.count()) + " colours>";
        });
    module.def(
        "colour_constraints", &colour, py::arg("constraints"), py::arg("fixed") = py::none(),
        "Colours constraints on two, three or four vertices each, so that no two of a colour share "
        "a vertex.\n\n"
        "constraints  integer array of shape (n, k), k from 2 to 4: Deformable.edges, or "
        "`vertices` "
        "of what\n"
        "             within returned. A constraint may repeat a vertex\n"
        "fixed        true for vertices that no constraint moves: these may be shared\n\n"
        "Returns ConstraintColours: each constraint has the first colour that no earlier one at "
        "its "
        "vertices has.\n"
        "Raises Error (bad_argument) if a vertex has no entry in fixed.");
}

} // namespace

void bind_near_results(py::module_& module) {
    RecordBinder<FeaturePair>(
        module, "FeaturePair",
        "Two features at rest that are near each other. The gradient of their "
        "distance by vertices[i] is weights[i] * normal.")
        .field("kind", &FeaturePair::kind, "ElementaryKind")
        .field("face_first", &FeaturePair::face_first,
               "the face is the first surface's, the vertex the second's")
        .field("side", &FeaturePair::side,
               "1, -1 or 0: the side of the triangle that the vertex is on, or the sign of the "
               "edges' volume. Exact")
        .field("a", &FeaturePair::a, "vertex, or edge")
        .field("b", &FeaturePair::b, "triangle, or edge")
        .field("vertices", &FeaturePair::vertices, "those of a, then those of b")
        .field("distance", &FeaturePair::distance, "length")
        .field("limit", &FeaturePair::limit, "the distance up to which this pair is listed")
        .field("barycentric", &FeaturePair::barycentric, "of the closest points")
        .field("weights", &FeaturePair::weights,
               "of the vertices: the sum of weight times position is point_a - point_b")
        .field("point_a", &FeaturePair::point_a, "closest point of a")
        .field("point_b", &FeaturePair::point_b, "closest point of b")
        .field("normal", &FeaturePair::normal, "unit vector from point_b to point_a")
        .done();
    RecordBinder<SurfaceContact>(
        module, "SurfaceContact",
        "A point of a surface that is near a rigid body, or in it. Outside "
        "of the body the gradient of the distance by vertices[i] is "
        "weights[i] * normal.")
        .field("feature", &SurfaceContact::feature,
               "Feature: the part of the surface that has the point in its inside")
        .field("id", &SurfaceContact::id, "vertex, row of Deformable.edges or of Deformable.faces")
        .field("vertices", &SurfaceContact::vertices, "of that part; the last one is repeated")
        .field("weights", &SurfaceContact::weights, "of the vertices, sum 1")
        .field("distance", &SurfaceContact::distance, "along the normal; negative in a solid")
        .field("limit", &SurfaceContact::limit, "the distance up to which this contact is listed")
        .field("point", &SurfaceContact::point, "on the surface")
        .field("point_on_body", &SurfaceContact::point_on_body, "on the body's boundary")
        .field("normal", &SurfaceContact::normal, "unit vector out of the body")
        .field("triangle", &SurfaceContact::triangle, "of a Model, that of point_on_body; else 0")
        .done();
    bind_near_vertices(module);
    bind_colours(module);
}

void bind_near_queries(py::module_& /*module*/, const AddQuery& add) {
    add("self_within", "surface, distance, *, at_end=False, vertices=None, progress=None", 2,
        "surface distance * at_end vertices progress",
        "Every vertex and face, and every two edges, of a Deformable that are near each other at "
        "one "
        "end of the step.\n\n"
        "distance    length; the thicknesses of both features are added to it\n"
        "at_end      take the positions at the end of the step, not those at its start\n"
        "vertices    NearVertices: thickness, groups, masks and marks of moved vertices; within() "
        "of two surfaces\n"
        "            has vertices_b as well\n"
        "progress    function of (stage, fraction)\n\n"
        "Returns a record array of FeaturePair, each pair once, sorted. Raises Error "
        "(bad_argument) "
        "if the distance\n"
        "is negative, or if an array has another length than there are vertices.",
        run_self_within);
    add_overload("within", {a_surface_and_a_length,
                            {"a b distance * at_end vertices vertices_b progress pose", 3},
                            run_surfaces_within});
    add_overload("within", {a_surface,
                            {"surface body pose distance * at_end vertices progress", 4},
                            run_placed_body_within});
}

} // namespace abut::python
