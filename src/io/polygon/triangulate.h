#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A corner of a polygon in a plane.
struct PlaneCorner {
    std::uint32_t vertex = 0; ///< is handed on
    double x = 0, y = 0;
};

/// Work of a triangulation, counted.
struct TriangulationWork {
    std::uint64_t tests = 0;  ///< of corners for being ears
    std::uint64_t visits = 0; ///< of corners and of groups of them by these tests
};

/// A polygon in a plane, counter-clockwise, as exactly n - 2 triangles.
///
/// In/out      corners: n >= 3; appends to triangles, in the polygon's orientation; adds to work, if
///             there is one.
/// Degenerate  corners may repeat, lie on a line, touch other corners or edges (a hole that two
///             coincident edges join to the outline is a part of it): no triangle is turned over,
///             and their areas add up to the polygon's. A polygon that crosses itself is cut
///             somehow; signed areas add up to its own even then.
/// Cost        O(n log n) for polygons met in practice; O(n^2) at worst.
/// Source      ear clipping [Meisters 1975], shortest diagonal first. Differs: a k-d tree finds what
///             lies in an ear; an ear that is not free waits for the corner that it is not free of.
void triangulate_in_plane(std::span<const PlaneCorner> corners,
                          std::vector<std::array<std::uint32_t, 3>>& triangles,
                          TriangulationWork* work = nullptr);

/// A polygon in space, cut in the plane of two axes in which its area is largest; see
/// triangulate_in_plane.
///
/// In/out      corners: n >= 3 indices in range of positions, which have members x, y, z of type
///             float or double; appends to triangles.
template <typename Position>
void triangulate(std::span<const std::uint32_t> corners, const Position* positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Corners seen along the axis in which Newell's normal is longest, counter-clockwise.
template <typename Position>
std::vector<PlaneCorner> project_polygon(std::span<const std::uint32_t> corners,
                                         const Position* positions) {
    const auto at = [&](std::uint32_t vertex) {
        const Position& p = positions[vertex];
        return std::array<double, 3>{p.x, p.y, p.z};
    };
    // Relative to a corner: far from the origin, the products of coordinates would swallow the area.
    const auto origin = at(corners[0]);
    const auto relative = [&](std::uint32_t vertex) {
        auto p = at(vertex);
        for (std::size_t i = 0; i < 3; ++i)
            p[i] -= origin[i];
        return p;
    };
    std::array<double, 3> n{};
    auto p = relative(corners.back());
    for (const std::uint32_t corner : corners) {
        const auto q = relative(corner);
        n[0] += (p[1] - q[1]) * (p[2] + q[2]);
        n[1] += (p[2] - q[2]) * (p[0] + q[0]);
        n[2] += (p[0] - q[0]) * (p[1] + q[1]);
        p = q;
    }
    unsigned axis = std::fabs(n[1]) > std::fabs(n[0]) ? 1 : 0;
    axis = std::fabs(n[2]) > std::fabs(n.at(axis)) ? 2 : axis;
    const unsigned u = (axis + 1) % 3;
    const unsigned v = (axis + 2) % 3;
    const double sign = n.at(axis) < 0 ? -1 : 1;
    std::vector<PlaneCorner> flat;
    flat.reserve(corners.size());
    for (const std::uint32_t vertex : corners)
        flat.push_back({vertex, sign * at(vertex).at(u), at(vertex).at(v)});
    return flat;
}

template <typename Position>
void triangulate(std::span<const std::uint32_t> corners, const Position* positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (corners.size() == 3)
        triangles.push_back({corners[0], corners[1], corners[2]});
    else
        triangulate_in_plane(project_polygon(corners, positions), triangles);
}

} // namespace abut
