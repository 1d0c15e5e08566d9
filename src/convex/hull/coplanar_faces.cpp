#include "convex/hull/coplanar_faces.h"

#include "core/disjoint_sets.h"
#include "math/predicates.h"

#include <algorithm>

namespace abut {

namespace {

/// One side of a triangle: its ends in ascending order, and the triangle's third corner as `apex`.
struct Side {
    std::uint32_t low, high, apex, triangle;
};

std::vector<Side> sides_by_edge(std::span<const IndexTriangle> triangles) {
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = triangles[i][k], w = triangles[i][(k + 1) % 3];
            sides.push_back({std::min(v, w), std::max(v, w), triangles[i][(k + 2) % 3], i});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
        return s.low != t.low ? s.low < t.low : s.high < t.high;
    });
    return sides;
}

} // namespace

std::vector<std::uint32_t> coplanar_groups(std::span<const Vec3> points,
                                           std::span<const IndexTriangle> triangles) {
    DisjointSets sets(triangles.size());
    const std::vector<Side> sides = sides_by_edge(triangles);
    for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
        const Side &s = sides[i], &t = sides[i + 1];
        if (orient3d(points[s.low], points[s.high], points[s.apex], points[t.apex]) == 0)
            sets.unite(s.triangle, t.triangle);
    }
    std::vector<std::uint32_t> group(triangles.size());
    for (std::uint32_t i = 0, count = 0; i < triangles.size(); ++i)
        group[i] = sets.root(i) == i ? count++ : group[sets.root(i)];
    return group;
}

} // namespace abut
