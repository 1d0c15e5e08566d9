#pragma once

#include <abut/rigid.h>

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/transform.h"

#include <cmath>
#include <vector>

/// Reference answers from testing every pair of triangles. Only their boxes save work.
namespace abut::test {

struct PlacedTriangle {
    Triangle corners;
    Box3 box;
};

inline std::vector<PlacedTriangle> placed_triangles(const Mesh& mesh, const Transform& world) {
    std::vector<PlacedTriangle> result;
    for (const auto& t : mesh.triangles) {
        PlacedTriangle p;
        for (std::size_t k = 0; k < 3; ++k) {
            p.corners[k] = apply(world, mesh.positions[t[k]]);
            extend(p.box, p.corners[k]);
        }
        result.push_back(p);
    }
    return result;
}

inline double box_distance_sq(const Box3& a, const Box3& b) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double gap = std::max({0.0, component(a.lower, axis) - component(b.upper, axis),
                                     component(b.lower, axis) - component(a.upper, axis)});
        sum += gap * gap;
    }
    return sum;
}

inline std::vector<TrianglePair> brute_pairs(const std::vector<PlacedTriangle>& a,
                                             const std::vector<PlacedTriangle>& b) {
    std::vector<TrianglePair> pairs;
    for (std::uint32_t i = 0; i < a.size(); ++i)
        for (std::uint32_t j = 0; j < b.size(); ++j)
            if (overlap(a[i].box, b[j].box) &&
                triangle_triangle_intersect(a[i].corners, b[j].corners) != TriangleContact::none)
                pairs.push_back({i, j});
    return pairs;
}

/// In: no two triangles meet. Returns infinity if there are no triangles.
inline double brute_distance(const std::vector<PlacedTriangle>& a,
                             const std::vector<PlacedTriangle>& b) {
    double best_sq = HUGE_VAL;
    for (const PlacedTriangle& s : a)
        for (const PlacedTriangle& t : b)
            if (box_distance_sq(s.box, t.box) * (1 - 1e-12) < best_sq)
                best_sq =
                    std::min(best_sq, triangle_triangle_distance(s.corners, t.corners).distance_sq);
    return std::sqrt(best_sq);
}

} // namespace abut::test
