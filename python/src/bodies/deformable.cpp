#include <abut/deformable.h>

#include "bodies/surface.h"
#include "module.h"
#include "queries/queries.h"
#include "support/meshes.h"

#include <string>

namespace abut::python {

namespace {

ElementaryOptions options_of_impacts(const Arguments& arguments, std::size_t first) {
    ElementaryOptions options;
    arguments.take(first, "absolute_error", options.absolute_error);
    arguments.take(first + 1, "thickness", options.thickness);
    return options;
}

py::object run_self_impacts(const Arguments& arguments) {
    const auto options = options_of_impacts(arguments, 1);
    return py::cast(
        read_one(arguments, 3, [&](const Deformable& surface, const Progress& progress) {
            return self_impacts(surface, options, progress);
        }));
}
py::object run_impacts(const Arguments& arguments) {
    const auto options = options_of_impacts(arguments, 2);
    return py::cast(read_two(
        arguments, 4, [&](const Deformable& a, const Deformable& b, const Progress& progress) {
            return impacts(a, b, options, progress);
        }));
}
py::object run_self_time(const Arguments& arguments) {
    const auto options = options_of_impacts(arguments, 1);
    return py::cast(
        read_one(arguments, 3, [&](const Deformable& surface, const Progress& progress) {
            return self_time_of_impact(surface, options, progress);
        }));
}
py::object run_time(const Arguments& arguments) {
    const auto options = options_of_impacts(arguments, 2);
    return py::cast(read_two(
        arguments, 4, [&](const Deformable& a, const Deformable& b, const Progress& progress) {
            return time_of_impact(a, b, options, progress);
        }));
}
py::object run_self_free(const Arguments& arguments) {
    const auto options = options_of_impacts(arguments, 1);
    return py::cast(
        read_one(arguments, 3, [&](const Deformable& surface, const Progress& progress) {
            return is_free_of_self_impacts(surface, options, progress);
        }));
}
py::object run_free(const Arguments& arguments) {
    const auto options = options_of_impacts(arguments, 2);
    return py::cast(read_two(
        arguments, 4, [&](const Deformable& a, const Deformable& b, const Progress& progress) {
            return is_free_of_impacts(a, b, options, progress);
        }));
}
py::object run_self_intersections(const Arguments& arguments) {
    IntersectionOptions options;
    arguments.take(1, "at_end", options.at_end);
    return records(read_one(arguments, 2, [&](const Deformable& surface, const Progress& progress) {
        options.progress = progress;
        return self_intersections(surface, options);
    }));
}
py::object run_intersections(const Arguments& arguments) {
    IntersectionOptions options;
    arguments.take(2, "at_end", options.at_end);
    return records(read_two(
        arguments, 3, [&](const Deformable& a, const Deformable& b, const Progress& progress) {
            options.progress = progress;
            return intersections(a, b, options);
        }));
}

/// Impacts of another surface could name triangles that this one has not.
void check_features(const Deformable& surface, const Impacts& impacts) {
    for (const FeatureImpact& one : impacts.list) {
        const bool faces = one.kind == ElementaryKind::vertex_face;
        const std::size_t most_a = faces ? surface.vertex_count() : surface.edges().size();
        const std::size_t most_b = faces ? surface.triangles().size() : surface.edges().size();
        if (one.a >= most_a || one.b >= most_b)
            throw py::value_error("impacts: they are not this surface's");
    }
}

template <class Change>
void change_surface(Surface& surface, Change change) {
    const InUse::Change use(surface.use, kSurface);
    const py::gil_scoped_release unlocked;
    change(surface.value);
}

/// Reads a member of a surface that another thread may be about to change.
template <class Read>
auto read_surface(Surface& surface, Read read) {
    const InUse::Read use(surface.use, kSurface);
    return read(std::as_const(surface.value));
}

py::class_<Surface> surface_class(py::module_& module) {
    return py::class_<Surface>(
               module, "Deformable",
               "Deformable(vertices, faces, *, scheme='representative', assignment='greedy', "
               "culling='tree', lean=False)\n\n"
               "A triangle mesh whose vertices move from step to step: in a step every vertex goes "
               "in a "
               "straight line from\n"
               "its start to its end while t goes from 0 to 1. Takes what Model takes; at rest "
               "until the "
               "first step.\n\n"
               "lean keeps no boxes of features: less than half of the memory, somewhat slower.\n"
               "Several threads may query it; a change while a query runs raises RuntimeError.\n"
               "Raises Error (bad_mesh) as Model.")
        .def(py::init([](const py::object& vertices, const py::object& faces, Scheme scheme,
                         Assignment assignment, Culling culling, bool lean) {
                 Mesh mesh = to_mesh_value(vertices, faces);
                 const py::gil_scoped_release unlocked;
                 return std::make_unique<Surface>(
                     std::move(mesh), DeformableOptions{scheme, assignment, culling, lean});
             }),
             py::arg("vertices"), py::arg("faces") = py::none(), py::kw_only(),
             py::arg("scheme") = "representative", py::arg("assignment") = "greedy",
             py::arg("culling") = "tree", py::arg("lean") = false)
        .def(
            "set_motion",
            [](Surface& self, const py::object& start, const py::object& end) {
                const auto from = to_points(start, "start"), to = to_points(end, "end");
                change_surface(self, [&](Deformable& surface) { surface.set_motion(from, to); });
            },
            py::arg("start"), py::arg("end"),
            "Sets the step: where every vertex is at t = 0 and t = 1, arrays of shape (n, 3).\n\n"
            "Raises Error: bad_argument if there are not as many positions as vertices, bad_mesh "
            "if a coordinate is not\n"
            "finite or beyond 1e18. Nothing has changed then.")
        .def(
            "advance",
            [](Surface& self, const py::object& end) {
                auto to = to_points(end, "end");
                change_surface(self, [&](Deformable& surface) { surface.advance(std::move(to)); });
            },
            py::arg("end"),
            "Sets the next step: the end of the last one is its start. Errors as set_motion.")
        .def(
            "set_mesh",
            [](Surface& self, const py::object& vertices, const py::object& faces) {
                Mesh mesh = to_mesh_value(vertices, faces);
                change_surface(self,
                               [&](Deformable& surface) { surface.set_mesh(std::move(mesh)); });
            },
            py::arg("vertices"), py::arg("faces") = py::none(),
            "Takes another mesh, at rest: cutting, fracture, remeshing. Errors as the "
            "constructor.");
}

void add_surface_members(py::class_<Surface>& type) {
    type.def(
            "adapt",
            [](Surface& self, const Impacts& impacts) {
                change_surface(self, [&](Deformable& surface) {
                    check_features(surface, impacts);
                    surface.adapt(impacts);
                });
            },
            py::arg("impacts"),
            "Moves features off triangles that met something, for assignment='adaptive'. In: the "
            "result of\n"
            "self_impacts of this surface. Changes no answer.")
        .def(
            "model",
            [](Surface& self) {
                const InUse::Read read(self.use, kSurface);
                const py::gil_scoped_release unlocked;
                return self.value.model();
            },
            "The surface at the start of its step as a Model, for every query that takes one. Its "
            "hierarchy is\n"
            "refitted from step to step. The model keeps its positions when the surface moves on.")
        .def_property_readonly(
            "vertex_count",
            [](Surface& self) {
                return read_surface(self, [](const auto& value) { return value.vertex_count(); });
            })
        .def_property_readonly(
            "faces",
            [](Surface& self) {
                return rows<std::uint32_t>(
                    read_surface(self, [](const auto& value) { return value.triangles(); }));
            },
            "uint32 array of shape (m, 3)")
        .def_property_readonly(
            "edges",
            [](Surface& self) {
                return rows<std::uint32_t>(
                    read_surface(self, [](const auto& value) { return value.edges(); }));
            },
            "uint32 array of shape (k, 2): every pair of vertices that a triangle joins")
        .def_property_readonly("bytes",
                               [](Surface& self) {
                                   return read_surface(
                                       self, [](const auto& value) { return value.bytes(); });
                               })
        .def("__repr__", [](Surface& self) {
            return read_surface(self, [](const auto& value) {
                return "<abut.Deformable: " + std::to_string(value.vertex_count()) + " vertices, " +
                       std::to_string(value.triangles().size()) + " triangles>";
            });
        });
}

void bind_class(py::module_& module) {
    auto surface = surface_class(module);
    add_surface_members(surface);
}

void bind_results(py::module_& module) {
    RecordBinder<FeatureImpact>(module, "FeatureImpact", "Two features that meet.")
        .field("kind", &FeatureImpact::kind, "ElementaryKind")
        .field("status", &FeatureImpact::status, "Status")
        .field("face_first", &FeatureImpact::face_first,
               "the face is the first surface's, the vertex the second's")
        .field("a", &FeatureImpact::a, "vertex, or edge")
        .field("b", &FeatureImpact::b, "triangle, or edge")
        .field("time", &FeatureImpact::time, "in [0, 1], never later than the contact")
        .field("barycentric", &FeatureImpact::barycentric,
               "weights in the face, or parameters on the edges")
        .field("normal", &FeatureImpact::normal, "unit vector from b towards a")
        .done();
    RecordBinder<EdgeFaceIntersection>(module, "EdgeFaceIntersection",
                                       "An edge and a face at rest that share a point.")
        .field("face_first", &EdgeFaceIntersection::face_first,
               "the face is the first surface's, the edge the second's")
        .field("edge", &EdgeFaceIntersection::edge, "row of Deformable.edges")
        .field("face", &EdgeFaceIntersection::face, "row of Deformable.faces")
        .field("contact", &EdgeFaceIntersection::contact, "EdgeFaceContact")
        .field("point", &EdgeFaceIntersection::point,
               "a shared point; of a shared segment, its middle")
        .field("along", &EdgeFaceIntersection::along,
               "on the edge: 0 at its first vertex, 1 at "
               "its second")
        .field("barycentric", &EdgeFaceIntersection::barycentric, "weights in the face")
        .done();
    RecordBinder<TestCounts>(module, "TestCounts", "A number for each kind of test.")
        .field("vertex_face", &TestCounts::vertex_face, "")
        .field("edge_edge", &TestCounts::edge_edge, "")
        .done();
    RecordBinder<DeformableCounters>(module, "DeformableCounters", "The work that a query did.")
        .field("triangle_pairs", &DeformableCounters::triangle_pairs, "whose boxes overlap")
        .field("candidates", &DeformableCounters::candidates,
               "TestCounts of feature pairs to be tested")
        .field("elementary_tests", &DeformableCounters::elementary_tests,
               "TestCounts of those whose roots were searched")
        .field("exact_fallbacks", &DeformableCounters::exact_fallbacks,
               "of these, those that integers decided")
        .done();
    PlainBinder<Impacts>(module, "Impacts", "Returned by impacts and self_impacts.")
        .property(
            "list", [](const Impacts& self) { return records(self.list); },
            "record array of FeatureImpact, sorted by kind, face_first, a, b")
        .field("counters", &Impacts::counters, "DeformableCounters")
        .done()
        .def("__len__", [](const Impacts& self) { return self.list.size(); });
}

constexpr const char* kOptions =
    "absolute_error  length; 0: exact. Else features that come so near may be reported too\n"
    "thickness       length at which features count as meeting\n"
    "progress        function of (stage, fraction)\n\n";

void bind_queries_at_rest(const AddQuery& add) {
    const std::string at_rest =
        "at_end    take the positions at the end of the step, not those at its start\n"
        "progress  function of (stage, fraction)\n\n"
        "Returns a record array of EdgeFaceIntersection, each pair once, sorted. Exact.";
    add("self_intersections", "surface, *, at_end=False, progress=None", 1,
        "surface * at_end progress",
        "Every edge and face of a Deformable at rest that share a point, but no vertex: where it "
        "passes through itself.\n\n" +
            at_rest,
        run_self_intersections);
    add("intersections", "a, b, *, at_end=False, progress=None", 2, "a b * at_end progress",
        "Every edge and face of two Deformable at rest that share a point.\n\n" + at_rest,
        run_intersections);
}

void bind_surface_queries(py::module_& module) {
    static std::vector<std::string> docs;
    docs.reserve(16);
    const AddQuery add = [&](const char* name, const char* parameters, std::size_t required,
                             const char* list, const std::string& doc,
                             py::object (*run)(const Arguments&)) {
        docs.push_back(std::string(name) + "(" + parameters + ")\n--\n\n" + doc);
        add_verb(module, name, docs.back().c_str());
        add_overload(name, {a_surface, {list, required}, run});
    };
    static const std::string options = kOptions;
    const auto text = [](const char* first, const char* last) {
        return std::string(first) + "\n\n" + options + last;
    };
    constexpr const char* kOne = "surface, *, absolute_error=0, thickness=0, progress=None";
    constexpr const char* kTwo = "a, b, *, absolute_error=0, thickness=0, progress=None";
    add("self_impacts", kOne, 1, "surface * absolute_error thickness progress",
        text("Every vertex and face, and every two edges, of a Deformable that meet during its "
             "step.",
             "Returns Impacts. Complete and exact. Raises Error (bad_argument) for a negative "
             "length."),
        run_self_impacts);
    add("impacts", kTwo, 2, "a b * absolute_error thickness progress",
        text("Every vertex and face, and every two edges, of two Deformable that meet during their "
             "step.",
             "Returns Impacts. Complete and exact. Raises Error (bad_argument) also if their "
             "schemes differ."),
        run_impacts);
    add("self_time_of_impact", kOne, 1, "surface * absolute_error thickness progress",
        text("The earliest of self_impacts.", "Returns FeatureImpact, or None."), run_self_time);
    add("is_free_of_self_impacts", kOne, 1, "surface * absolute_error thickness progress",
        text(
            "Whether no features of a Deformable meet during its step. Stops at the first that do.",
            "Returns a bool."),
        run_self_free);
    add("is_free_of_impacts", kTwo, 2, "a b * absolute_error thickness progress",
        text("Whether no features of two Deformable meet during their step. Stops at the first "
             "that do.",
             "Returns a bool."),
        run_free);
    bind_queries_at_rest(add);
    bind_near_queries(module, add);
    add_overload("time_of_impact",
                 {a_surface, {"a b * absolute_error thickness progress", 2}, run_time});
}

} // namespace

void bind_deformable(py::module_& module) {
    bind_enum<Assignment>(
        module, "Assignment",
        {"greedy", "maximal", "uniform_vertex_edge", "uniform_edge_edge", "adaptive"},
        "Which one of its triangles represents a vertex or an edge.");
    bind_enum<Scheme>(module, "Scheme",
                      {"representative", "database", "markup", "basic", "features", "pairwise"},
                      "How pairs of triangles that may meet become tests of features.");
    bind_enum<Culling>(module, "Culling", {"tree", "grid", "sweep"},
                       "How pairs of triangles that may meet are found.");
    bind_enum<EdgeFaceContact>(module, "EdgeFaceContact", {"crossing", "touching", "coplanar"},
                               "How an edge and a face that share a point lie to each other.");
    bind_results(module);
    bind_class(module);
    bind_near_results(module);
    bind_surface_queries(module);
    bind_representatives(module);
}

} // namespace abut::python
