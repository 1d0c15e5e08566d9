#include "geometry/triangle_triangle_distance.h"

#include "geometry/triangle_triangle_intersect.h"

#include <algorithm>

namespace abut {

namespace {

double clamp01(double v) {
    return std::min(std::max(v, 0.0), 1.0);
}

void keep_nearer(ClosestPoints& best, const ClosestPoints& c) {
    if (c.distance_sq < best.distance_sq)
        best = c;
}

ClosestPoints swapped(const ClosestPoints& c) {
    return {c.distance_sq, c.b, c.a};
}

/// Foot of p on the plane of t, if it lies within t, and the vector to it.
struct Foot {
    bool within = false;
    Vec3 point, gap;
};

Foot foot_within(const Vec3& p, const Triangle& t) {
    // Along the longest edge u, where a needle's foot is well determined whatever its width.
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (length_sq(t[(i + 1) % 3] - t[i]) > length_sq(t[(k + 1) % 3] - t[k]))
            k = i;
    const Vec3& origin = t[k];
    const Vec3 u = t[(k + 1) % 3] - origin, v = t[(k + 2) % 3] - origin, w = p - origin;
    const Vec3 n = cross(u, v);
    const double nn = length_sq(n);
    if (!(nn > 0))
        return {};
    // h = (u x w) . n / n.n, and the best g for that h: what h is off by, g makes up for.
    const double h = dot(cross(u, w), n) / nn, g = dot(w - h * v, u) / length_sq(u);
    if (!(g >= 0 && h >= 0 && g + h <= 1))
        return {};
    const Vec3 foot = g * u + h * v;
    return {true, origin + foot, w - foot};
}

/// Where the segment p q pierces t, if its ends lie on both sides.
bool pierce(const Vec3& p, const Vec3& q, const Triangle& t, Vec3& point) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double sp = dot(n, p - t[0]), sq = dot(n, q - t[0]);
    if (!((sp > 0 && sq < 0) || (sp < 0 && sq > 0)))
        return false;
    const Vec3 crossing = p + (sp / (sp - sq)) * (q - p);
    const Foot foot = foot_within(crossing, t);
    point = foot.point;
    return foot.within;
}

} // namespace

ClosestPoints segment_segment_distance(const Vec3& p0, const Vec3& p1, const Vec3& q0,
                                       const Vec3& q1) {
    const Vec3 u = p1 - p0, v = q1 - q0, r = q0 - p0;
    const double uu = length_sq(u), vv = length_sq(v), uv = dot(u, v);
    const Vec3 n = cross(u, v);
    const double nn = length_sq(n);
    // Lines: s = (r x v) . n / n.n. Then the best t for that s, and the best s for that t.
    double s = nn > 0 ? clamp01(dot(cross(r, v), n) / nn) : 0;
    const double t = vv > 0 ? clamp01((s * uv - dot(r, v)) / vv) : 0;
    s = uu > 0 ? clamp01((t * uv + dot(r, u)) / uu) : 0;
    const Vec3 gap = r - s * u + t * v;
    return {length_sq(gap), p0 + s * u, q0 + t * v};
}

ClosestPoints point_triangle_distance(const Vec3& p, const Triangle& t) {
    ClosestPoints best = segment_segment_distance(p, p, t[0], t[1]);
    keep_nearer(best, segment_segment_distance(p, p, t[1], t[2]));
    keep_nearer(best, segment_segment_distance(p, p, t[2], t[0]));
    if (const Foot foot = foot_within(p, t); foot.within)
        keep_nearer(best, {length_sq(foot.gap), p, foot.point});
    return best;
}

ClosestPoints triangle_triangle_distance(const Triangle& a, const Triangle& b) {
    ClosestPoints best = segment_segment_distance(a[0], a[1], b[0], b[1]);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            keep_nearer(best, segment_segment_distance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
    for (std::size_t i = 0; i < 3; ++i) {
        if (const Foot foot = foot_within(a[i], b); foot.within)
            keep_nearer(best, {length_sq(foot.gap), a[i], foot.point});
        if (const Foot foot = foot_within(b[i], a); foot.within)
            keep_nearer(best, swapped({length_sq(foot.gap), b[i], foot.point}));
    }
    // Rounded signs alone would let needles cross that are apart.
    if (best.distance_sq == 0 || triangle_triangle_intersect(a, b) == TriangleContact::none)
        return best;
    Vec3 point;
    for (std::size_t i = 0; i < 3; ++i)
        if (pierce(a[i], a[(i + 1) % 3], b, point) || pierce(b[i], b[(i + 1) % 3], a, point))
            return {0, point, point};
    return best;
}

} // namespace abut
