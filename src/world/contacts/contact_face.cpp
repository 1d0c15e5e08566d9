#include "world/contacts/contact_face.h"

#include "convex/body/convex_data.h"
#include "convex/hull/climb.h"
#include "math/transform.h"
#include "world/solids/box_face.h"

#include <cmath>
#include <limits>

namespace abut {

namespace {

/// A face whose normal makes a smaller cosine with the direction stands on edge: its height over
/// the contact would be known too badly.
constexpr double kOnEdge = 0x1p-10;

/// An edge of a convex body from a vertex to another.
struct HullEdge {
    std::uint32_t from = 0, to = 0, number = 0;
};

/// The edge at a vertex that is most nearly perpendicular to a direction.
HullEdge flattest_edge(const Convex& body, const FaceTable& faces, std::uint32_t vertex,
                       const Vec3& direction) {
    HullEdge best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t face : faces.faces_at(vertex)) {
        const auto corners = faces.corners(face);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const HullEdge edge{corners[i].vertex,
                                corners[i + 1 == corners.size() ? 0 : i + 1].vertex,
                                corners[i].edge};
            if (edge.from != vertex && edge.to != vertex)
                continue;
            const Vec3 way =
                normalized_or_zero(body.vertices()[edge.to] - body.vertices()[edge.from]);
            if (const double slope = std::abs(dot(way, direction)); slope < least)
                least = slope, best = edge;
        }
    }
    return best;
}

} // namespace

ContactFace contact_face(const RoundedBox& box, const Vec3& direction, const Vec3& origin) {
    const BoxFace chosen(box, direction);
    const auto k = chosen.k, u = chosen.u, v = chosen.v;
    ContactFace face;
    face.normal = chosen.normal(box);
    face.radius = box.radius;
    const Vec3 middle = (box.centre - origin) + box.half[k] * face.normal;
    // With u x v along the outward normal, the corners below run counter-clockwise.
    const Vec3 way_u = box.half[u] * box.axis[u], way_v = box.half[v] * box.axis[v];
    const std::uint32_t side = chosen.side, bit_u = chosen.bit_u(), bit_v = chosen.bit_v();
    const auto& edge = BoxFace::edge;
    if (box.half[u] > 0 && box.half[v] > 0) {
        face.corners = {{middle + way_u + way_v, side | bit_u | bit_v, edge(u, side | bit_v)},
                        {middle - way_u + way_v, side | bit_v, edge(v, side)},
                        {middle - way_u - way_v, side, edge(u, side)},
                        {middle + way_u - way_v, side | bit_u, edge(v, side | bit_u)}};
    } else if (box.half[u] > 0 || box.half[v] > 0) {
        const std::size_t axis = box.half[u] > 0 ? u : v;
        const Vec3 way = box.half[u] > 0 ? way_u : way_v;
        const std::uint32_t bit = box.half[u] > 0 ? bit_u : bit_v;
        face.corners = {{middle - way, side, edge(axis, side)},
                        {middle + way, side | bit, edge(axis, side)}};
    } else {
        face.corners = {{middle, side, 0}};
    }
    return face;
}

ContactFace contact_face(const Convex& body, const FaceTable& faces,
                         const Transform& world_from_body, const Vec3& direction,
                         const Vec3& origin) {
    const auto& m = world_from_body.m;
    const Vec3 offset = Vec3{m[9], m[10], m[11]} - origin;
    const auto placed_vertex = [&](std::uint32_t vertex) {
        return apply_linear(world_from_body, body.vertices()[vertex]) + offset;
    };
    ContactFace result;
    if (body.dimension() < 2) {
        for (std::uint32_t v = 0; v < body.vertices().size(); ++v)
            result.corners.push_back({placed_vertex(v), v, 0});
        return result;
    }
    const Vec3 along = pull_back(world_from_body, direction);
    const HullLevel& hull = body.data().levels.front();
    const std::uint32_t vertex = hull.number[farthest(hull.polytope, along)];
    double best = kOnEdge;
    std::uint32_t face = 0;
    for (const std::uint32_t other : faces.faces_at(vertex))
        if (const double cosine = dot(faces.normal(other), along); cosine > best)
            best = cosine, face = other;
    if (best == kOnEdge) {
        const HullEdge edge = flattest_edge(body, faces, vertex, along);
        result.corners = {{placed_vertex(edge.from), edge.from, edge.number},
                          {placed_vertex(edge.to), edge.to, edge.number}};
        return result;
    }
    result.normal = apply_linear(world_from_body, faces.normal(face));
    const auto corners = faces.corners(face);
    result.corners.reserve(corners.size());
    for (const FaceTable::Corner& corner : corners)
        result.corners.push_back({placed_vertex(corner.vertex), corner.vertex, corner.edge});
    return result;
}

ContactFace contact_face(const SupportShape& solid, const Vec3& direction, const Vec3& origin) {
    const CurvedSide side = side_towards(solid, direction);
    const Vec3 offset = solid.centre - origin;
    ContactFace face;
    face.normal = side.normal;
    face.corners.reserve(side.corners.size());
    for (const CurvedSide::Corner& corner : side.corners)
        face.corners.push_back({corner.at + offset, corner.vertex, corner.edge});
    return face;
}

} // namespace abut
