#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A polygon of n vertices as exactly n - 2 triangles, by ear clipping in the plane of its mean
/// normal.
///
/// Assimp's own step gives up on polygons that are not simple and loses a part of them; this one
/// never does.
///
/// In/out      corners: n >= 3 indices in range of positions, which have members x, y, z of type
///             float or double; appends to triangles, in the polygon's orientation.
/// Degenerate  where no ear is left (self-intersecting, flat to a line) the first corner is cut off.
/// Cost        O(n^2) for usual polygons, O(n^3) at worst.
template <typename Position>
void triangulate(std::span<const std::uint32_t> corners, const Position* positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

namespace detail {

struct PolygonCorner {
    std::uint32_t vertex;
    double x, y;
};

inline double doubled_area(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Corners seen along the axis in which Newell's normal is longest, counter-clockwise.
template <typename Position>
std::vector<PolygonCorner> project_polygon(std::span<const std::uint32_t> corners,
                                           const Position* positions) {
    const auto at = [&](std::uint32_t vertex) {
        const Position& p = positions[vertex];
        return std::array<double, 3>{p.x, p.y, p.z};
    };
    double n[3] = {0, 0, 0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto p = at(corners[i]);
        const auto q = at(corners[(i + 1) % corners.size()]);
        n[0] += (p[1] - q[1]) * (p[2] + q[2]);
        n[1] += (p[2] - q[2]) * (p[0] + q[0]);
        n[2] += (p[0] - q[0]) * (p[1] + q[1]);
    }
    unsigned axis = std::fabs(n[1]) > std::fabs(n[0]) ? 1 : 0;
    axis = std::fabs(n[2]) > std::fabs(n[axis]) ? 2 : axis;
    const unsigned u = (axis + 1) % 3;
    const unsigned v = (axis + 2) % 3;
    const double sign = n[axis] < 0 ? -1 : 1;
    std::vector<PolygonCorner> flat;
    flat.reserve(corners.size());
    for (const std::uint32_t vertex : corners)
        flat.push_back({vertex, sign * at(vertex).at(u), at(vertex).at(v)});
    return flat;
}

inline bool is_ear(const std::vector<PolygonCorner>& polygon, std::size_t tip) {
    const std::size_t count = polygon.size();
    const PolygonCorner& a = polygon[(tip + count - 1) % count];
    const PolygonCorner& b = polygon[tip];
    const PolygonCorner& c = polygon[(tip + 1) % count];
    if (!(doubled_area(a, b, c) > 0))
        return false;
    for (std::size_t i = 2; i + 1 < count; ++i) {
        const PolygonCorner& p = polygon[(tip + i) % count];
        const bool inside =
            doubled_area(a, b, p) >= 0 && doubled_area(b, c, p) >= 0 && doubled_area(c, a, p) >= 0;
        const bool is_end = (p.x == a.x && p.y == a.y) || (p.x == c.x && p.y == c.y);
        if (inside && !is_end)
            return false;
    }
    return true;
}

} // namespace detail

template <typename Position>
void triangulate(std::span<const std::uint32_t> corners, const Position* positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (corners.size() == 3) {
        triangles.push_back({corners[0], corners[1], corners[2]});
        return;
    }
    std::vector<detail::PolygonCorner> polygon = detail::project_polygon(corners, positions);
    std::size_t tip = 1;
    while (polygon.size() > 3) {
        const std::size_t count = polygon.size();
        std::size_t tries = 0;
        while (tries < count && !detail::is_ear(polygon, (tip + tries) % count))
            ++tries;
        tip = tries == count ? 0 : (tip + tries) % count;
        triangles.push_back({polygon[(tip + count - 1) % count].vertex, polygon[tip].vertex,
                             polygon[(tip + 1) % count].vertex});
        polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(tip));
    }
    triangles.push_back({polygon[0].vertex, polygon[1].vertex, polygon[2].vertex});
}

} // namespace abut
