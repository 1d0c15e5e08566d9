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
    std::uint32_t vertex = 0; ///< copied to the triangles
    double x = 0, y = 0;
};

/// The work of a triangulation.
struct TriangulationWork {
    std::uint64_t tests = 0;  ///< corners tested for being ears
    std::uint64_t visits = 0; ///< corners, and groups of corners, that these tests visited
};

/// Cuts a polygon in a plane, counter-clockwise, into exactly n - 2 triangles.
///
/// In/out      corners: n >= 3. triangles: appended to, in the polygon's orientation. work: added
///             to, unless null.
/// Degenerate  corners may repeat, lie on a line, or touch other corners or edges; a hole that two
///             coincident edges connect to the outline is part of it. No triangle is reversed, and
///             the areas add up to the polygon's. A polygon that crosses itself gets some
///             triangulation whose signed areas add up to its own.
/// Cost        O(n log n) for polygons in practice; O(n^2) at worst.
/// Source      ear clipping [Meisters 1975], shortest diagonal first. Differs: a k-d tree finds the
///             corners in an ear; a blocked ear waits for the corner that blocks it.
void triangulate_in_plane(std::span<const PlaneCorner> corners,
                          std::vector<std::array<std::uint32_t, 3>>& triangles,
                          TriangulationWork* work = nullptr);

/// Cuts a polygon in space, in the plane of the two axes in which its area is largest; see
/// triangulate_in_plane.
///
/// In/out      corners: n >= 3 indices in range of positions, which have members x, y, z of type
///             float or double; appends to triangles.
template <typename Position>
void triangulate(std::span<const std::uint32_t> corners, const Position* positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Projects corners along the axis in which Newell's normal is longest, counter-clockwise.
template <typename Position>
std::vector<PlaneCorner> project_polygon(std::span<const std::uint32_t> corners,
                                         const Position* positions) {
    const auto at = [&](std::uint32_t vertex) {
        const Position& p = positions[vertex];
        return std::array<double, 3>{p.x, p.y, p.z};
    };
    // Relative to a corner, because far from the origin cancellation would destroy the area.
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
