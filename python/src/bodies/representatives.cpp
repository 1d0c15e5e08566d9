#include <abut/error.h>
#include <abut/representatives.h>

#include "bodies/surface.h"
#include "support/arrays.h"
#include "support/enums.h"
#include "support/records.h"
#include "support/work.h"

#include <string>

namespace abut::python {

namespace {

constexpr const char* kRepresentatives = "the representatives";

/// Representatives as Python keeps them: several threads may read them, one may change them.
struct KeptRepresentatives {
    Representatives value;
    InUse use;
};

std::vector<TrianglePair> to_triangle_pairs(const py::object& object) {
    const auto given = py::array::ensure(object);
    if (given && given.size() == 0)
        return {};
    if (!given || (given.dtype().kind() != 'i' && given.dtype().kind() != 'u')) {
        PyErr_Clear();
        throw py::type_error("pairs: an array of integers is wanted");
    }
    if (given.ndim() != 2 || given.shape(1) != 2)
        throw py::value_error("pairs: an array of shape (n, 2) is wanted");
    const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> wide(given);
    std::vector<TrianglePair> pairs(static_cast<std::size_t>(wide.shape(0)));
    const auto index = [&](std::size_t pair, std::size_t i) {
        const std::int64_t value = wide.data()[2 * pair + i];
        if (value < 0 || value > 0xffffffff)
            throw Error(ErrorCode::bad_argument, "pair " + std::to_string(pair) +
                                                     " names triangle " + std::to_string(value));
        return static_cast<std::uint32_t>(value);
    };
    for (std::size_t i = 0; i < pairs.size(); ++i)
        pairs[i] = {index(i, 0), index(i, 1)};
    return pairs;
}

template <class Read>
auto read(KeptRepresentatives& kept, Read get) {
    const InUse::Read use(kept.use, kRepresentatives);
    return get(std::as_const(kept.value));
}

py::class_<KeptRepresentatives> bind_class(py::module_& module) {
    return py::class_<KeptRepresentatives>(
               module, "Representatives",
               "Representatives(vertex_count, faces, *, assignment='greedy')\n\n"
               "The triangles of a surface, with exactly one of its triangles for every vertex and "
               "every edge: the one that\n"
               "represents it. For a culling of your own, with self_feature_tests and "
               "feature_tests.\n\n"
               "Several threads may read it; a change meanwhile raises RuntimeError.\n"
               "Raises Error (bad_mesh) if an index is out of range.")
        .def(py::init([](std::size_t vertex_count, const py::object& faces, Assignment assignment) {
                 auto triangles = to_triangles(faces, vertex_count);
                 const py::gil_scoped_release unlocked;
                 return std::unique_ptr<KeptRepresentatives>(new KeptRepresentatives{
                     Representatives(vertex_count, std::move(triangles), assignment), {}});
             }),
             py::arg("vertex_count"), py::arg("faces"), py::kw_only(),
             py::arg("assignment") = "greedy")
        .def(
            "set_triangles",
            [](KeptRepresentatives& self, std::size_t vertex_count, const py::object& faces) {
                const auto triangles = to_triangles(faces, vertex_count);
                const InUse::Change use(self.use, kRepresentatives);
                const py::gil_scoped_release unlocked;
                self.value.set_triangles(vertex_count, triangles);
            },
            py::arg("vertex_count"), py::arg("faces"),
            "Replaces the triangles and forgets the motion. A triangle that keeps its index and "
            "its vertices keeps its edges'\n"
            "numbers and the features that it represents. Errors as the constructor.")
        .def(
            "set_motion",
            [](KeptRepresentatives& self, const py::object& start, const py::object& end) {
                const auto from = to_points(start, "start"), to = to_points(end, "end");
                const InUse::Change use(self.use, kRepresentatives);
                const py::gil_scoped_release unlocked;
                self.value.set_motion(from, to);
            },
            py::arg("start"), py::arg("end"),
            "Sets where every vertex is at t = 0 and t = 1, arrays of shape (n, 3). From then on "
            "only features are tested\n"
            "whose boxes come near each other. Errors as Deformable.set_motion.");
}

void add_members(py::class_<KeptRepresentatives>& type) {
    type.def_property_readonly(
            "vertex_count",
            [](KeptRepresentatives& self) {
                return read(self, [](const auto& value) { return value.vertex_count(); });
            })
        .def_property_readonly(
            "triangles",
            [](KeptRepresentatives& self) {
                return rows<std::uint32_t>(
                    read(self, [](const auto& value) { return value.triangles(); }));
            },
            "uint32 array of shape (m, 3)")
        .def_property_readonly(
            "edges",
            [](KeptRepresentatives& self) {
                return rows<std::uint32_t>(
                    read(self, [](const auto& value) { return value.edges(); }));
            },
            "uint32 array of shape (k, 2); 2^32 - 1 twice where there is no edge any more")
        .def_property_readonly(
            "represented",
            [](KeptRepresentatives& self) {
                return numbers(read(self, [](const auto& value) { return value.represented(); }));
            },
            "uint8 array: bit k for a triangle's vertex k, bit 3 + k for its edge k")
        .def_property_readonly("bytes", [](KeptRepresentatives& self) {
            return read(self, [](const auto& value) { return value.bytes(); });
        });
}

void bind_queries(py::module_& module) {
    module.def(
        "self_feature_tests",
        [](KeptRepresentatives& surface, const py::object& pairs, double margin) {
            const auto list = to_triangle_pairs(pairs);
            const InUse::Read use(surface.use, kRepresentatives);
            std::vector<FeatureTest> tests;
            {
                const py::gil_scoped_release unlocked;
                tests = self_feature_tests(surface.value, list, margin);
            }
            return records(std::move(tests));
        },
        py::arg("representatives"), py::arg("pairs"), py::kw_only(), py::arg("margin") = 0.0,
        "self_feature_tests(representatives, pairs, *, margin=0)\n\n"
        "The tests to which pairs of triangles of one surface lead, each once.\n\n"
        "pairs   array of shape (n, 2): each pair of triangles at most once, also neighbours\n"
        "margin  length: features nearer than this are tested too\n\n"
        "Returns a record array of FeatureTest. Raises Error (bad_argument) for an index out of "
        "range.");
    module.def(
        "feature_tests",
        [](KeptRepresentatives& a, KeptRepresentatives& b, const py::object& pairs, double margin) {
            const auto list = to_triangle_pairs(pairs);
            const InUse::Read use_a(a.use, kRepresentatives), use_b(b.use, kRepresentatives);
            std::vector<FeatureTest> tests;
            {
                const py::gil_scoped_release unlocked;
                tests = feature_tests(a.value, b.value, list, margin);
            }
            return records(std::move(tests));
        },
        py::arg("representatives_a"), py::arg("representatives_b"), py::arg("pairs"), py::kw_only(),
        py::arg("margin") = 0.0,
        "feature_tests(representatives_a, representatives_b, pairs, *, margin=0)\n\n"
        "As self_feature_tests, but between two surfaces: pairs of a triangle of each.");
}

} // namespace

void bind_representatives(py::module_& module) {
    RecordBinder<FeatureTest>(module, "FeatureTest", "Two features to be tested.")
        .field("kind", &FeatureTest::kind, "ElementaryKind")
        .field("face_first", &FeatureTest::face_first,
               "the face is the first surface's, the vertex the second's")
        .field("a", &FeatureTest::a, "vertex, or edge")
        .field("b", &FeatureTest::b, "triangle, or edge")
        .field("vertices", &FeatureTest::vertices,
               "the vertex, then the face's three; or the edges' two each")
        .done();
    auto type = bind_class(module);
    add_members(type);
    bind_queries(module);
}

} // namespace abut::python
