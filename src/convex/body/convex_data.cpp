#include "convex/body/convex_data.h"

#include "convex/hull/coplanar_faces.h"
#include "convex/hull/walkable_hull.h"
#include "convex/search/closest_points.h"
#include "math/transform.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace abut {

namespace {

/// Hulls with at most kCoarsest vertices are not simplified; a simpler hull has about 1/kReduction
/// of the vertices.
constexpr std::size_t kCoarsest = 48, kReduction = 4;
/// Vertices of a hull on which walking from any start is cheap enough.
constexpr std::size_t kEntry = 3000;

double reach_of(std::span<const Vec3> points) {
    double reach = 0;
    for (const Vec3& p : points)
        reach = std::max(reach, sum_of_sizes(p));
    return reach;
}

NormalTable make_table(const Polytope& polytope, std::size_t cells) {
    const double resolution = std::round(std::sqrt(static_cast<double>(cells)));
    return {polytope, std::max(1U, static_cast<std::uint32_t>(resolution))};
}

HullLevel make_level(std::span<const Vec3> points, std::span<const IndexTriangle> triangles) {
    HullLevel level;
    level.polytope = make_polytope(points, triangles);
    level.polytope.starts = make_table(level.polytope, 4 * points.size());
    return level;
}

/// The hull of the vertices that are farthest along evenly spread directions.
HullLevel coarser(const HullLevel& fine) {
    const std::vector<HullVertex>& all = fine.polytope.vertices;
    std::vector<std::uint32_t> kept = make_table(fine.polytope, all.size() / kReduction).vertices();
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    std::vector<Vec3> points;
    points.reserve(kept.size());
    for (const std::uint32_t v : kept)
        points.push_back(all[v].at);
    // Vertices of a hull are also vertices of the hull of any subset that holds them.
    const HullSurface hull = exact_hull(points);
    HullLevel level = make_level(points, hull.triangles);
    for (const std::uint32_t v : kept)
        level.number.push_back(fine.number[v]);
    return level;
}

/// The largest distance of a vertex from a hull inside, with a margin for rounding.
double deviation(std::span<const Vec3> vertices, const HullLevel& level, double rounding) {
    double largest = 0;
    const Transform unmoved;
    const Vec3& centre = level.polytope.vertices[0].at;
    for (const Vec3& v : vertices) {
        const Polytope point = make_polytope({&v, 1}, {});
        ClosestPointSearch search;
        search.at.a = vertex_feature(level.polytope.starts.vertex(v - centre));
        find_closest_points({level.polytope, unmoved, point, unmoved}, rounding, search);
        largest = std::max(largest, std::sqrt(search.at.distance_sq));
    }
    return largest + 8 * rounding;
}

template <typename T>
std::size_t bytes_of(const std::vector<T>& values) {
    return values.capacity() * sizeof(T);
}

} // namespace

ConvexData::ConvexData(std::span<const Vec3> points) {
    LeftOutVertices without;
    HullSurface hull = walkable_hull(points, &without);
    dimension = hull.dimension;
    source = hull.vertices;
    std::vector<std::uint32_t> number(points.size());
    for (std::uint32_t v = 0; v < source.size(); ++v) {
        vertices.push_back(points[source[v]]);
        number[source[v]] = v;
    }
    triangles = std::move(hull.triangles);
    for (IndexTriangle& t : triangles)
        for (std::uint32_t& v : t)
            v = number[v];
    for (const std::uint32_t v : without.vertices)
        left_out.push_back(points[v]);
    outside = without.outside;
    reach = std::max(reach_of(vertices), reach_of(left_out));
    ball = inner_ball(vertices, triangles);
    levels.push_back(make_level(vertices, triangles));
    levels[0].number.resize(vertices.size());
    std::iota(levels[0].number.begin(), levels[0].number.end(), 0);
    number_features();
    simplify();
    while (entry + 1 < levels.size() && levels[entry].polytope.vertices.size() > kEntry)
        ++entry;
}

void ConvexData::number_features() {
    const Polytope& p = levels[0].polytope;
    // A polygon has one face on each side; the triangles of the top come first.
    std::vector<std::uint32_t> face_of;
    if (dimension == 3)
        face_of = coplanar_groups(vertices, triangles);
    else
        for (std::size_t i = 0; i < triangles.size(); ++i)
            face_of.push_back(i < triangles.size() / 2 ? 0 : 1);

    face_number.resize(p.edge_end());
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const HullVertex& v = p.vertices[triangles[i][k]];
            std::uint32_t edge = v.first_edge;
            while (p.target(edge) != triangles[i][(k + 1) % 3])
                ++edge;
            face_number[edge] = face_of[i];
        }

    edge_number.assign(p.edge_end(), kNoEdge);
    for (std::uint32_t v = 0; v < p.vertices.size(); ++v)
        for (std::uint32_t k = 0; k < p.vertices[v].degree; ++k) {
            const std::uint32_t e = p.vertices[v].first_edge + k, twin = p.twin(e);
            if (e > twin || (dimension > 1 && face_number[e] == face_number[twin]))
                continue;
            edge_number[e] = edge_number[twin] = static_cast<std::uint32_t>(edges.size());
            edges.push_back({v, p.target(e)});
        }

    // The border of a face: each edge is followed by the one that leaves its end and also has the
    // face on its left.
    const std::uint32_t faces =
        face_of.empty() ? 0 : 1 + *std::max_element(face_of.begin(), face_of.end());
    std::vector<std::uint32_t> border(faces, kNoEdge);
    for (std::uint32_t e = 0; e < p.edge_end(); ++e)
        if (faces > 0 && edge_number[e] != kNoEdge)
            border[face_number[e]] = e;
    for (const std::uint32_t first : border) {
        face_begin.push_back(static_cast<std::uint32_t>(face_vertices.size()));
        std::uint32_t edge = first;
        do {
            face_vertices.push_back(p.origin(edge));
            const HullVertex& end = p.vertices[p.target(edge)];
            edge = p.before(end, p.twin(edge));
            while (edge_number[edge] == kNoEdge)
                edge = p.before(end, edge);
        } while (edge != first);
    }
    face_begin.push_back(static_cast<std::uint32_t>(face_vertices.size()));
}

void ConvexData::simplify() {
    const double rounding = reach * 0x1p-49;
    while (levels.back().polytope.vertices.size() > kCoarsest) {
        HullLevel next = coarser(levels.back());
        if (next.polytope.vertices.size() * 4 > levels.back().polytope.vertices.size() * 3)
            break;
        next.deviation = deviation(vertices, next, rounding);
        levels.push_back(std::move(next));
    }
}

std::size_t ConvexData::bytes() const {
    std::size_t sum = sizeof(*this) + bytes_of(vertices) + bytes_of(source) + bytes_of(left_out) +
                      bytes_of(edges) + bytes_of(face_begin) + bytes_of(face_vertices) +
                      bytes_of(triangles) + bytes_of(edge_number) + bytes_of(face_number);
    for (const HullLevel& level : levels)
        sum += sizeof(level) + level.polytope.bytes() + bytes_of(level.number);
    return sum;
}

} // namespace abut
