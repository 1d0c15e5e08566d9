#include <abut/error.h>
#include <abut/representatives.h>

#include "core/parallel.h"
#include "deform/feature_boxes.h"
#include "mesh/changing_surface.h"
#include "mesh/surface_features.h"
#include "mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace abut {

struct RepresentativesData {
    ChangingSurface surface;
    std::optional<FeatureBoxes> boxes; ///< if there is a motion
};

namespace {

constexpr std::size_t kMostTriangles = std::size_t{1} << 28;
constexpr std::size_t kMovedVerticesAtOnce = 4096;

void require_valid_triangles(std::size_t vertices, std::span<const IndexTriangle> triangles) {
    if (vertices > kNoEdge)
        throw Error(ErrorCode::bad_mesh, "more than 2^32 - 1 vertices");
    if (triangles.size() > kMostTriangles)
        throw Error(ErrorCode::bad_mesh, "more than 2^28 triangles");
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (const std::uint32_t v : triangles[i])
            if (v >= vertices)
                throw Error(ErrorCode::bad_mesh, "triangle " + std::to_string(i) + " uses vertex " +
                                                     std::to_string(v) + " of " +
                                                     std::to_string(vertices));
}

/// Checks the triangles before they are moved.
std::vector<IndexTriangle> valid_triangles(std::size_t vertices,
                                           std::vector<IndexTriangle> triangles) {
    require_valid_triangles(vertices, triangles);
    return triangles;
}

/// Spawns the tests of triangle pairs of two surfaces, or of one if both are the same object.
class TestSpawner {
public:
    TestSpawner(const RepresentativesData& a, const RepresentativesData& b, float margin)
        : a_(a), b_(b), is_self_(&a == &b), has_boxes_(a.boxes && b.boxes), margin_(margin) {}

    void spawn(TrianglePair pair) {
        const ChangingSurface &a = a_.surface, &b = b_.surface;
        const Represented bits_a = a.represented()[pair.a], bits_b = b.represented()[pair.b];
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; represents_edge(bits_a, i) && k < 3; ++k)
                if (represents_edge(bits_b, k))
                    add_edges(a.edges_of()[pair.a][i], b.edges_of()[pair.b][k]);
        for (std::size_t i = 0; i < 3; ++i)
            if (represents_vertex(bits_a, i))
                add_vertex_face(a_, a.triangles()[pair.a][i], b_, pair.b, false);
        for (std::size_t i = 0; i < 3; ++i)
            if (represents_vertex(bits_b, i))
                add_vertex_face(b_, b.triangles()[pair.b][i], a_, pair.a, !is_self_);
    }
    std::vector<FeatureTest> take() { return std::move(tests_); }

private:
    void add_edges(std::uint32_t e, std::uint32_t f) {
        if (is_self_ && e > f)
            std::swap(e, f);
        if (has_boxes_ && are_apart(a_.boxes->edges[e], b_.boxes->edges[f], margin_))
            return;
        const auto &v = a_.surface.edges()[e], &w = b_.surface.edges()[f];
        if (is_self_ && (v[0] == w[0] || v[0] == w[1] || v[1] == w[0] || v[1] == w[1]))
            return;
        tests_.push_back({ElementaryKind::edge_edge, false, e, f, {v[0], v[1], w[0], w[1]}});
    }
    void add_vertex_face(const RepresentativesData& of_vertex, std::uint32_t v,
                         const RepresentativesData& of_face, std::uint32_t face, bool face_first) {
        if (has_boxes_ &&
            are_apart(of_vertex.boxes->vertices[v], of_face.boxes->faces[face], margin_))
            return;
        const IndexTriangle& f = of_face.surface.triangles()[face];
        if (is_self_ && (f[0] == v || f[1] == v || f[2] == v))
            return;
        tests_.push_back({ElementaryKind::vertex_face, face_first, v, face, {v, f[0], f[1], f[2]}});
    }

    const RepresentativesData& a_;
    const RepresentativesData& b_;
    bool is_self_, has_boxes_;
    float margin_;
    std::vector<FeatureTest> tests_;
};

std::vector<FeatureTest> spawn_tests(const RepresentativesData& a, const RepresentativesData& b,
                                     std::span<const TrianglePair> pairs, double margin) {
    if (!(margin >= 0 && std::isfinite(margin)))
        throw Error(ErrorCode::bad_argument, "the margin must be a finite number of at least 0");
    const std::size_t count_a = a.surface.triangles().size(),
                      count_b = b.surface.triangles().size();
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i].a >= count_a || pairs[i].b >= count_b)
            throw Error(ErrorCode::bad_argument, "pair " + std::to_string(i) + " names triangles " +
                                                     std::to_string(pairs[i].a) + " and " +
                                                     std::to_string(pairs[i].b) +
                                                     ", but there are " + std::to_string(count_a) +
                                                     " and " + std::to_string(count_b));
    // All boxes overlap at four times the largest coordinate: no larger margin is needed.
    TestSpawner spawner(a, b, round_up(std::min(margin, 4 * kLargestCoordinate)));
    for (const TrianglePair& pair : pairs)
        if (&a != &b || pair.a != pair.b)
            spawner.spawn(pair);
    return spawner.take();
}

} // namespace

Representatives::Representatives(std::size_t vertices,
                                 std::vector<std::array<std::uint32_t, 3>> triangles,
                                 Assignment assignment)
    : data_(new RepresentativesData{
          ChangingSurface(vertices, valid_triangles(vertices, std::move(triangles)), assignment),
          std::nullopt}) {}
Representatives::~Representatives() = default;
Representatives::Representatives(Representatives&&) noexcept = default;
Representatives& Representatives::operator=(Representatives&&) noexcept = default;

void Representatives::set_triangles(std::size_t vertices,
                                    std::span<const std::array<std::uint32_t, 3>> triangles) {
    require_valid_triangles(vertices, triangles);
    data_->surface.set(vertices, triangles);
    data_->boxes.reset();
}

void Representatives::set_motion(std::span<const Vec3> start, std::span<const Vec3> end) {
    const ChangingSurface& surface = data_->surface;
    if (start.size() != surface.vertices() || end.size() != surface.vertices())
        throw Error(ErrorCode::bad_argument, std::to_string(start.size()) + " and " +
                                                 std::to_string(end.size()) + " positions for " +
                                                 std::to_string(surface.vertices()) + " vertices");
    require_valid_positions(start);
    require_valid_positions(end);
    std::vector<MovingBox> vertices(surface.vertices());
    parallel_for(vertices.size(), kMovedVerticesAtOnce, [&](std::size_t i) {
        vertices[i] = {Aabb(Box3{start[i], start[i]}), Aabb(Box3{end[i], end[i]})};
    });
    data_->boxes.emplace(std::move(vertices), surface.edges(), surface.triangles());
}

std::size_t Representatives::vertex_count() const noexcept {
    return data_->surface.vertices();
}
const std::vector<std::array<std::uint32_t, 3>>& Representatives::triangles() const noexcept {
    return data_->surface.triangles();
}
const std::vector<std::array<std::uint32_t, 2>>& Representatives::edges() const noexcept {
    return data_->surface.edges();
}
const std::vector<std::uint8_t>& Representatives::represented() const noexcept {
    return data_->surface.represented();
}
std::size_t Representatives::bytes() const noexcept {
    return data_->surface.bytes() + (data_->boxes ? data_->boxes->bytes() : 0);
}

std::vector<FeatureTest> self_feature_tests(const Representatives& surface,
                                            std::span<const TrianglePair> pairs, double margin) {
    return spawn_tests(surface.data(), surface.data(), pairs, margin);
}

std::vector<FeatureTest> feature_tests(const Representatives& a, const Representatives& b,
                                       std::span<const TrianglePair> pairs, double margin) {
    if (&a == &b)
        throw Error(ErrorCode::bad_argument, "one surface given twice: use self_feature_tests");
    return spawn_tests(a.data(), b.data(), pairs, margin);
}

} // namespace abut
