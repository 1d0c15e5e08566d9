#include "geometry/triangle_triangle_distance.h"

#include "geometry/nearest-inl.h"
#include "geometry/triangle_triangle_intersect.h"

#include <algorithm>

namespace abut {

SegmentPoints nearest_on_segments(const Vec3& u, const Vec3& v, const Vec3& r) {
    return HWY_NAMESPACE::nearest_on_segments(u, v, r);
}

namespace {

void keep_nearer(ClosestPoints& best, const ClosestPoints& c) {
    if (c.distance_sq < best.distance_sq)
        best = c;
}

ClosestPoints swapped(const ClosestPoints& c) {
    return {c.distance_sq, c.b, c.a, c.on_b, c.on_a};
}

TriangleFeature vertex(std::size_t i) {
    return {Feature::vertex, static_cast<std::uint8_t>(i)};
}
TriangleFeature edge(std::size_t i) {
    return {Feature::edge, static_cast<std::uint8_t>(i)};
}
/// The feature at parameter s of the edge from vertex i.
TriangleFeature on_edge(std::size_t i, double s) {
    return s <= 0 ? vertex(i) : s >= 1 ? vertex((i + 1) % 3) : edge(i);
}

/// The point at parameter s, exact at both ends.
Vec3 point_of_segment(const Vec3& p, const Vec3& q, double s) {
    return s >= 1 ? q : p + s * (q - p);
}

/// Closest points of edge i of a and edge j of b.
ClosestPoints edge_edge_distance(const Triangle& a, std::size_t i, const Triangle& b,
                                 std::size_t j) {
    const Vec3 &p0 = a[i], &p1 = a[(i + 1) % 3], &q0 = b[j], &q1 = b[(j + 1) % 3];
    const SegmentPoints c = nearest_on_segments(p1 - p0, q1 - q0, q0 - p0);
    return {c.distance_sq, point_of_segment(p0, p1, c.s), point_of_segment(q0, q1, c.t),
            on_edge(i, c.s), on_edge(j, c.t)};
}

/// Whether the segment p q pierces t, its ends lying strictly on different sides. Out: where.
bool pierce(const Vec3& p, const Vec3& q, const Triangle& t, Vec3& point) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double sp = dot(n, p - t[0]), sq = dot(n, q - t[0]);
    if (!((sp > 0 && sq < 0) || (sp < 0 && sq > 0)))
        return false;
    const Vec3 crossing = p + (sp / (sp - sq)) * (q - p);
    const TriangleFoot foot = foot_within(crossing, t);
    point = foot.point;
    return foot.within;
}

} // namespace

ClosestPoints segment_segment_distance(const Vec3& p0, const Vec3& p1, const Vec3& q0,
                                       const Vec3& q1) {
    const SegmentPoints c = nearest_on_segments(p1 - p0, q1 - q0, q0 - p0);
    return {c.distance_sq, point_of_segment(p0, p1, c.s), point_of_segment(q0, q1, c.t)};
}

ClosestPoints triangle_triangle_distance(const Triangle& a, const Triangle& b) {
    ClosestPoints best = edge_edge_distance(a, 0, b, 0);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            keep_nearer(best, edge_edge_distance(a, i, b, j));
    for (std::size_t i = 0; i < 3; ++i) {
        if (const TriangleFoot foot = foot_within(a[i], b); foot.within)
            keep_nearer(best, {length_sq(foot.gap), a[i], foot.point, vertex(i), {}});
        if (const TriangleFoot foot = foot_within(b[i], a); foot.within)
            keep_nearer(best, swapped({length_sq(foot.gap), b[i], foot.point, vertex(i), {}}));
    }
    // Rounded signs alone would report needles as crossing that are apart.
    if (best.distance_sq == 0 || triangle_triangle_intersect(a, b) == TriangleContact::none)
        return best;
    Vec3 point;
    for (std::size_t i = 0; i < 3; ++i) {
        if (pierce(a[i], a[(i + 1) % 3], b, point))
            return {0, point, point, edge(i), {}};
        if (pierce(b[i], b[(i + 1) % 3], a, point))
            return {0, point, point, {}, edge(i)};
    }
    return best;
}

} // namespace abut
