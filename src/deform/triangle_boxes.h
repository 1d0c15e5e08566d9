#pragma once

#include "deform/deformable_data.h"
#include "deform/triangle_pairs.h"
#include "math/vector.h"
#include "volume/aabb.h"

#include <cstdint>
#include <vector>

namespace abut {

/// The swept box of a triangle.
struct TriangleBox {
    Aabb box;
    std::uint32_t triangle = 0;
    bool second = false; ///< the triangle belongs to the second of two surfaces
};

/// The boxes of both surfaces' triangles, those of the first widened by `margin`; of one surface
/// only, if a and b are the same.
inline std::vector<TriangleBox> triangle_boxes(const DeformableData& a, const DeformableData& b,
                                               float margin) {
    std::vector<TriangleBox> boxes;
    const auto add = [&](const DeformableData& surface, bool second) {
        for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
            Box3 box;
            for (const std::uint32_t v : surface.triangles[i]) {
                extend(box, surface.vertices[v].start);
                extend(box, surface.vertices[v].end);
            }
            boxes.push_back({Aabb(box, second ? 0.0 : double{margin}), i, second});
        }
    };
    add(a, false);
    if (&a != &b)
        add(b, true);
    return boxes;
}

inline bool overlap(const Aabb& a, const Aabb& b) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (a.upper[axis] < b.lower[axis] || b.upper[axis] < a.lower[axis])
            return false;
    return true;
}

/// Visits two triangles if they are of different surfaces, or if there is only one surface. Returns
/// false to stop the search.
inline bool visit_pair(const TriangleBox& a, const TriangleBox& b, bool is_self,
                       TrianglePairVisitor& visitor) {
    if (is_self)
        return visitor.visit(a.triangle, b.triangle);
    if (a.second == b.second)
        return true;
    return a.second ? visitor.visit(b.triangle, a.triangle) : visitor.visit(a.triangle, b.triangle);
}

} // namespace abut
