#include "rigid/pair/gap_frame.h"

#include "geometry/triangle_triangle_distance.h"

namespace abut {

namespace {

/// The edge of a triangle that a closest point lies on; zero if it lies on no edge alone.
Vec3 edge_of(const Triangle& t, const TriangleFeature& on) {
    if (on.kind != Feature::edge)
        return {};
    return t[(on.index + 1U) % 3] - t[on.index];
}

/// The normal of a triangle whose inside a closest point lies in; else zero.
Vec3 normal_of(const Triangle& t, const TriangleFeature& on) {
    return on.kind == Feature::face ? cross(t[1] - t[0], t[2] - t[0]) : Vec3{};
}

/// A vector less its part along an edge. In: the edge may be zero.
Vec3 off_edge(const Vec3& v, const Vec3& edge) {
    const double sq = length_sq(edge);
    return sq > 0 ? v - (dot(v, edge) / sq) * edge : v;
}

} // namespace

GapFrame::GapFrame(const Vec3& origin, const Vec3& across) : origin_(origin) {
    const double size = max_abs(across);
    if (!(size > 0) || !is_finite(across))
        return;
    // Divided by the largest coordinate first, so that no square underflows.
    axes_[2] = normalized_or_zero({across.x / size, across.y / size, across.z / size});
    axes_[0] = perpendicular(axes_[2]);
    axes_[1] = cross(axes_[2], axes_[0]);
}

GapFrame GapFrame::between(const Triangle& a, const Triangle& b) {
    // Needles and nearly parallel edges have no good normal: it must lie along the difference.
    constexpr double kAlong = 1 - 0x1p-20;
    const ClosestPoints points = triangle_triangle_distance(a, b);
    const Vec3 across = points.b - points.a, edge_a = edge_of(a, points.on_a),
               edge_b = edge_of(b, points.on_b);
    for (const Vec3& normal :
         {normal_of(a, points.on_a), normal_of(b, points.on_b), cross(edge_a, edge_b)}) {
        const double along = dot(normal, across);
        if (std::abs(along) > kAlong * length(normal) * length(across))
            return {points.a, along > 0 ? normal : -normal};
    }
    return {points.a, off_edge(off_edge(across, edge_a), edge_b)};
}

} // namespace abut
