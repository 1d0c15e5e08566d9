#include "geometry/segment_triangle_contact.h"

#include "geometry/point_triangle_distance.h"
#include "geometry/triangle_planes.h"
#include "geometry/triangle_triangle_intersect.h"
#include "geometry/triangle_triangle_segment.h"
#include "math/predicates.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// The contact of a segment whose ends lie in the triangle's plane. A zero-area triangle has no
/// plane, so that every segment comes here.
SegmentContact contact_in_plane(const Vec3& p, const Vec3& q, const Triangle& t) {
    const bool flat = collinear(t[0], t[1], t[2]);
    bool meet = false;
    if (flat) {
        const auto [r, s] = triangle_planes::end_points(t);
        meet = segment_segment_intersect(p, q, r, s);
    } else {
        meet = segment_triangle_intersect(p, q, t);
    }
    if (!meet)
        return SegmentContact::none;
    return flat || p == q ? SegmentContact::touch : SegmentContact::coplanar;
}

} // namespace

SegmentContact segment_triangle_contact(const Vec3& p, const Vec3& q, const Triangle& t) {
    const auto [side_p, side_q] = triangle_planes::plane_sides(t, std::array{p, q});
    if (side_p * side_q > 0)
        return SegmentContact::none;
    if (side_p == 0 && side_q == 0)
        return contact_in_plane(p, q, t);
    // The line meets the plane in one point. It lies within the triangle if all edges turn the same
    // way around the line.
    const int u = orient3d(p, q, t[0], t[1]), v = orient3d(p, q, t[1], t[2]);
    if (u * v < 0)
        return SegmentContact::none;
    const int w = orient3d(p, q, t[2], t[0]);
    if (u * w < 0 || v * w < 0)
        return SegmentContact::none;
    const bool inside = u != 0 && v != 0 && w != 0;
    return inside && side_p * side_q < 0 ? SegmentContact::cross : SegmentContact::touch;
}

SegmentPoint segment_triangle_point(const Vec3& p, const Vec3& q, const Triangle& t) {
    // A triangle without area is the segment.
    const Intersection shared = triangle_triangle_segment(t, {p, q, q});
    // About the size 1, so that no product under- or overflows.
    double size = 0;
    for (const Vec3& v : {t[1] - t[0], t[2] - t[0], q - p})
        size = std::max({size, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    // 2^1022 also brings subnormal sizes there; a larger power may overflow.
    const double scale = size > 0 ? std::ldexp(1, std::min(1022, -std::ilogb(size))) : 1;
    const auto scaled = [&](const Vec3& v) { return scale * (v - t[0]); };
    const Vec3 way = scale * (q - p);
    const auto along = [&](const Vec3& point) {
        const double length_squared = length_sq(way);
        return length_squared > 0
                   ? std::clamp(dot(scale * (point - p), way) / length_squared, 0.0, 1.0)
                   : 0.0;
    };
    SegmentPoint found;
    found.point = shared.corners[0];
    found.along = along(found.point);
    if (shared.count > 1) {
        const auto [first, last] =
            std::minmax_element(shared.corners.begin(), shared.corners.begin() + shared.count,
                                [&](const Vec3& a, const Vec3& b) { return along(a) < along(b); });
        found.point = 0.5 * *first + 0.5 * *last;
        found.along = along(found.point);
    }
    found.weights =
        nearest_on_triangle(scaled(found.point), {scaled(t[0]), scaled(t[1]), scaled(t[2])})
            .weights;
    return found;
}

} // namespace abut
