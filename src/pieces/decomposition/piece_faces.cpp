#include "pieces/decomposition/piece_faces.h"

#include "convex/hull/coplanar_faces.h"
#include "math/predicates.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace abut {

namespace {

/// The triangles of a hull, and the triangle on the left of each edge.
struct HullTriangles {
    explicit HullTriangles(const Polytope& hull) : left_of(hull.edge_end(), kNoEdge) {
        for (std::uint32_t v = 0; v < hull.vertices.size(); ++v) {
            const HullVertex& vertex = hull.vertices[v];
            for (std::uint32_t e = vertex.first_edge; e < vertex.first_edge + vertex.degree; ++e) {
                if (left_of[e] != kNoEdge)
                    continue;
                // Walks around the triangle: the next edge precedes, around this edge's end, this
                // edge's twin.
                const auto next = [&](std::uint32_t edge) {
                    const HullVertex& end = hull.vertices[hull.target(edge)];
                    return hull.before(end, hull.twin(edge));
                };
                const std::uint32_t second = next(e), third = next(second);
                for (const std::uint32_t edge : {e, second, third})
                    left_of[edge] = static_cast<std::uint32_t>(corners.size());
                corners.push_back({v, hull.target(e), hull.target(second)});
            }
        }
    }

    std::vector<IndexTriangle> corners;
    std::vector<std::uint32_t> left_of;
};

using FaceTriangle = std::pair<std::uint32_t, std::uint32_t>; ///< a face, and a triangle of it

/// Lists the triangles of each face, in ascending order.
void list_triangles(std::vector<FaceTriangle> found, std::uint32_t face_count, PieceFaces& faces) {
    std::sort(found.begin(), found.end());
    faces.begin.assign(face_count + 1, 0);
    for (const auto& [face, t] : found) {
        ++faces.begin[face + 1];
        faces.triangles.push_back(t);
    }
    std::partial_sum(faces.begin.begin(), faces.begin.end(), faces.begin.begin());
}

} // namespace

PieceFaces find_piece_faces(const SurfaceGraph& surface, const Polytope& hull,
                            std::span<const std::uint32_t> source,
                            std::span<const std::uint32_t> triangles) {
    const HullTriangles hull_triangles(hull);
    std::vector<Vec3> points;
    for (const HullVertex& v : hull.vertices)
        points.push_back(v.at);
    const std::vector<std::uint32_t> face_of = coplanar_groups(points, hull_triangles.corners);
    PieceFaces faces;
    for (const std::uint32_t t : hull_triangles.left_of)
        faces.face_of_edge.push_back(t == kNoEdge ? kNoEdge : face_of[t]);

    std::vector<FaceTriangle> found;
    std::vector<std::uint32_t> order(source.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t v, std::uint32_t w) { return source[v] < source[w]; });
    const auto vertex_of = [&](std::uint32_t position) {
        const auto at = std::lower_bound(
            order.begin(), order.end(), position,
            [&](std::uint32_t v, std::uint32_t wanted) { return source[v] < wanted; });
        return at != order.end() && source[*at] == position ? *at : kNoEdge;
    };
    for (const std::uint32_t t : triangles) {
        if (surface.is_degenerate(t))
            continue;
        const Triangle corners = surface.triangle(t);
        const auto holds = [&](std::uint32_t hull_triangle) {
            const IndexTriangle& h = hull_triangles.corners[hull_triangle];
            return std::all_of(h.begin(), h.end(), [&](std::uint32_t v) {
                return orient3d(corners[0], corners[1], corners[2], points[v]) == 0;
            });
        };
        std::uint32_t at = kNoEdge;
        for (const std::uint32_t c : surface.corners[t])
            if (at == kNoEdge)
                at = vertex_of(c);
        if (at != kNoEdge) {
            const HullVertex& v = hull.vertices[at];
            for (std::uint32_t e = v.first_edge; e < v.first_edge + v.degree; ++e)
                if (holds(hull_triangles.left_of[e])) {
                    found.emplace_back(faces.face_of_edge[e], t);
                    break;
                }
            continue;
        }
        for (std::uint32_t h = 0; h < hull_triangles.corners.size(); ++h)
            if (holds(h)) {
                found.emplace_back(face_of[h], t);
                break;
            }
    }
    const std::uint32_t count =
        face_of.empty() ? 0 : 1 + *std::max_element(face_of.begin(), face_of.end());
    list_triangles(std::move(found), count, faces);
    return faces;
}

} // namespace abut
