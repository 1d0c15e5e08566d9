#include "geometry/point_triangle_distance.h"

#include <algorithm>

namespace abut {

TriangleFoot foot_within(const Vec3& p, const Triangle& t) {
    // Along the longest edge u, where a needle's foot is well determined whatever its width.
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (length_sq(t[(i + 1) % 3] - t[i]) > length_sq(t[(k + 1) % 3] - t[k]))
            k = i;
    const Vec3& origin = t[k];
    const Vec3 u = t[(k + 1) % 3] - origin, v = t[(k + 2) % 3] - origin, w = p - origin;
    const Vec3 n = cross(u, v);
    const double nn = length_sq(n), along = dot(cross(u, w), n);
    if (!(nn > 0 && along >= 0 && along <= nn))
        return {};
    // h = (u x w) . n / n.n, and the best g for that h: what h is off by, g makes up for.
    const double h = along / nn, g = dot(w - h * v, u) / length_sq(u);
    if (!(g >= 0 && g + h <= 1))
        return {};
    const Vec3 foot = g * u + h * v;
    TriangleFoot result{true, origin + foot, w - foot, {}};
    result.weights[k] = std::max(0.0, 1 - g - h);
    result.weights[(k + 1) % 3] = g;
    result.weights[(k + 2) % 3] = h;
    return result;
}

NearestOnTriangle nearest_on_triangle(const Vec3& p, const Triangle& t) {
    const std::array<Vec3, 3> w{p - t[0], p - t[1], p - t[2]};
    NearestOnTriangle best;
    for (std::uint8_t i = 0; i < 3; ++i)
        if (const double sq = length_sq(w[i]); i == 0 || sq < best.distance_sq)
            best = {sq, t[i], {}, 0, i};
    best.weights[best.index] = 1;
    for (std::uint8_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1U) % 3;
        const Vec3 edge = t[j] - t[i];
        const double along = dot(w[i], edge), all = length_sq(edge);
        if (!(along > 0 && along < all))
            continue;
        const double s = along / all;
        if (const double sq = length_sq(w[i] - s * edge); sq < best.distance_sq) {
            best = {sq, t[i] + s * edge, {}, 1, i};
            best.weights[i] = 1 - s, best.weights[j] = s;
        }
    }
    if (const TriangleFoot foot = foot_within(p, t); foot.within)
        if (const double sq = length_sq(foot.gap); sq < best.distance_sq)
            best = {sq, foot.point, foot.weights, 2, 0};
    return best;
}

ClosestPoints point_triangle_distance(const Vec3& p, const Triangle& t) {
    const NearestOnTriangle n = nearest_on_triangle(p, t);
    return {n.distance_sq, p, n.point};
}

} // namespace abut
