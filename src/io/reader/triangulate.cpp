#include "io/reader/triangulate.h"

#include <assimp/vector3.inl>
#include <cmath>
#include <cstddef>

namespace abut {

namespace {

struct Corner {
    std::uint32_t vertex;
    double x, y;
};

double doubled_area(const Corner& a, const Corner& b, const Corner& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Corners seen along the axis in which Newell's normal is longest, counter-clockwise.
std::vector<Corner> project(std::span<const std::uint32_t> corners, const aiVector3D* positions) {
    double n[3] = {0, 0, 0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const aiVector3D& p = positions[corners[i]];
        const aiVector3D& q = positions[corners[(i + 1) % corners.size()]];
        n[0] += (double{p.y} - q.y) * (double{p.z} + q.z);
        n[1] += (double{p.z} - q.z) * (double{p.x} + q.x);
        n[2] += (double{p.x} - q.x) * (double{p.y} + q.y);
    }
    unsigned axis = std::fabs(n[1]) > std::fabs(n[0]) ? 1 : 0;
    axis = std::fabs(n[2]) > std::fabs(n[axis]) ? 2 : axis;
    const unsigned u = (axis + 1) % 3;
    const unsigned v = (axis + 2) % 3;
    const double sign = n[axis] < 0 ? -1 : 1;
    std::vector<Corner> flat;
    flat.reserve(corners.size());
    for (const std::uint32_t vertex : corners)
        flat.push_back({vertex, sign * double{positions[vertex][u]}, double{positions[vertex][v]}});
    return flat;
}

bool is_ear(const std::vector<Corner>& polygon, std::size_t tip) {
    const std::size_t count = polygon.size();
    const Corner& a = polygon[(tip + count - 1) % count];
    const Corner& b = polygon[tip];
    const Corner& c = polygon[(tip + 1) % count];
    if (!(doubled_area(a, b, c) > 0))
        return false;
    for (std::size_t i = 2; i + 1 < count; ++i) {
        const Corner& p = polygon[(tip + i) % count];
        const bool inside =
            doubled_area(a, b, p) >= 0 && doubled_area(b, c, p) >= 0 && doubled_area(c, a, p) >= 0;
        const bool is_end = (p.x == a.x && p.y == a.y) || (p.x == c.x && p.y == c.y);
        if (inside && !is_end)
            return false;
    }
    return true;
}

} // namespace

void triangulate(std::span<const std::uint32_t> corners, const aiVector3D* positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (corners.size() == 3) {
        triangles.push_back({corners[0], corners[1], corners[2]});
        return;
    }
    std::vector<Corner> polygon = project(corners, positions);
    std::size_t tip = 1;
    while (polygon.size() > 3) {
        const std::size_t count = polygon.size();
        std::size_t tries = 0;
        while (tries < count && !is_ear(polygon, (tip + tries) % count))
            ++tries;
        tip = tries == count ? 0 : (tip + tries) % count;
        triangles.push_back({polygon[(tip + count - 1) % count].vertex, polygon[tip].vertex,
                             polygon[(tip + 1) % count].vertex});
        polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(tip));
    }
    triangles.push_back({polygon[0].vertex, polygon[1].vertex, polygon[2].vertex});
}

} // namespace abut
