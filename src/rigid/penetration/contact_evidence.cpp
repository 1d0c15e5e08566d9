#include "rigid/penetration/contact_evidence.h"

#include "math/predicates.h"
#include "rigid/penetration/edge_sectors.h"
#include "rigid/penetration/separating_motion.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace abut {

namespace {

/// How an edge of one triangle runs along another triangle for a positive length.
enum class Run : std::uint8_t { none, inside, along_edge };

struct EdgeRun {
    Run kind = Run::none;
    std::size_t edge = 0; ///< of the triangle, from this vertex to the next; if along_edge
    std::size_t left = 0, right = 0; ///< the triangle's vertices on either side; if inside
};

/// Classifies the edge e0 e1. In: t has an area, and e0, e1 lie in its plane.
EdgeRun edge_run(const Vec3& e0, const Vec3& e1, const Triangle& t, int axis) {
    std::array<int, 3> side{};
    for (std::size_t i = 0; i < 3; ++i)
        side[i] = orient2d(e0, e1, t[i], axis);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (side[i] != 0 || side[j] != 0)
            continue;
        // On one line: compare a coordinate in which the edge has a length.
        const int k = e0.x != e1.x ? 0 : e0.y != e1.y ? 1 : 2;
        const auto [e_low, e_high] = std::minmax({component(e0, k), component(e1, k)});
        const auto [t_low, t_high] = std::minmax({component(t[i], k), component(t[j], k)});
        const bool overlap = std::max(e_low, t_low) < std::min(e_high, t_high);
        return {overlap ? Run::along_edge : Run::none, i, 0, 0};
    }
    const auto left = std::find(side.begin(), side.end(), 1),
               right = std::find(side.begin(), side.end(), -1);
    if (left == side.end() || right == side.end())
        return {};
    // The line cuts the triangle. The edge misses the inside if both its ends lie beyond one of the
    // triangle's edges.
    const int winding = orient2d(t[0], t[1], t[2], axis);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &p = t[i], &q = t[(i + 1) % 3];
        if (orient2d(p, q, e0, axis) * winding <= 0 && orient2d(p, q, e1, axis) * winding <= 0)
            return {};
    }
    return {Run::inside, 0, static_cast<std::size_t>(left - side.begin()),
            static_cast<std::size_t>(right - side.begin())};
}

/// Adds the faces of a surface around an edge of one of its triangles, as rays around the line e0
/// e1.
void add_edge_rays(const WorldSolid& surface, std::uint32_t triangle, std::size_t edge,
                   const Vec3& e0, const Vec3& e1, bool of_a, EdgeSectors& sectors) {
    const int k = e0.x != e1.x ? 0 : e0.y != e1.y ? 1 : 2;
    const bool up = component(e0, k) < component(e1, k);
    for (const EdgeFace& face : surface.faces_around(triangle, edge)) {
        const bool face_up = component(face.from, k) < component(face.to, k);
        sectors.add({face.apex, of_a, surface.outward() * (face_up == up ? 1 : -1)});
    }
}

/// Tests the edges of a triangle of `first` that run along the triangle of `second`.
bool sectors_overlap(const WorldSolid& first, std::uint32_t i, const WorldSolid& second,
                     std::uint32_t j, bool first_is_a) {
    const Triangle s = first.world_triangle(i), t = second.world_triangle(j);
    const int axis = projection_axis(t);
    if (axis < 0)
        return false;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &e0 = s[k], &e1 = s[(k + 1) % 3];
        if (e0 == e1 || orient3d(t[0], t[1], t[2], e0) != 0 || orient3d(t[0], t[1], t[2], e1) != 0)
            continue;
        const EdgeRun run = edge_run(e0, e1, t, axis);
        if (run.kind == Run::none)
            continue;
        EdgeSectors sectors(e0, e1);
        add_edge_rays(first, i, k, e0, e1, first_is_a, sectors);
        if (run.kind == Run::along_edge) {
            add_edge_rays(second, j, run.edge, e0, e1, !first_is_a, sectors);
        } else {
            // (e0, e1, left) turns in the positive sense of the projection, (e0, e1, right) in the
            // negative.
            const int turn = second.outward() * orient2d(t[0], t[1], t[2], axis);
            sectors.add({t[run.left], !first_is_a, turn});
            sectors.add({t[run.right], !first_is_a, -turn});
        }
        if (sectors.interiors_overlap())
            return true;
    }
    return false;
}

/// Returns whether a vertex or the centroid of a triangle in contact, or another component of the
/// surface, lies strictly inside the solid.
bool reaches_inside(const WorldSolid& surface, std::vector<std::uint32_t> triangles,
                    const WorldSolid& solid) {
    if (!solid.bounds_solid())
        return false;
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    std::vector<Vec3> vertices = surface.component_points();
    for (const std::uint32_t i : triangles)
        for (const Vec3& vertex : surface.world_triangle(i))
            vertices.push_back(vertex);
    std::sort(vertices.begin(), vertices.end(), [](const Vec3& p, const Vec3& q) {
        return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    });
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const Vec3& vertex : vertices)
        if (solid.contains(vertex))
            return true;
    for (const std::uint32_t i : triangles) {
        const Triangle t = surface.world_triangle(i);
        const Vec3 middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
        // The centroid is rounded: it must lie farther inside than by its rounding.
        const double rounding =
            16 * 0x1p-53 * (std::abs(middle.x) + std::abs(middle.y) + std::abs(middle.z));
        if (solid.contains(middle) && !(solid.nearest(middle, 2 * rounding).distance <= rounding))
            return true;
    }
    return false;
}

} // namespace

Meeting examine_meeting(const WorldSolid& a, const WorldSolid& b,
                        std::span<const Contact> contacts) {
    if (std::any_of(contacts.begin(), contacts.end(),
                    [](const Contact& c) { return c.kind == TriangleContact::cross; }))
        return {true, {}};
    std::vector<std::uint32_t> of_a, of_b;
    for (const Contact& c : contacts) {
        of_a.push_back(c.pair.a);
        of_b.push_back(c.pair.b);
    }
    if (reaches_inside(a, std::move(of_a), b) || reaches_inside(b, std::move(of_b), a))
        return {true, {}};
    if (const Vec3 parting = nudge_that_parts(a, b, contacts); parting != Vec3{})
        return {false, parting};
    if (a.outward() == 0 || b.outward() == 0)
        return {true, {}};
    return {std::any_of(contacts.begin(), contacts.end(),
                        [&](const Contact& c) {
                            return sectors_overlap(a, c.pair.a, b, c.pair.b, true) ||
                                   sectors_overlap(b, c.pair.b, a, c.pair.a, false);
                        }),
            {}};
}

} // namespace abut
