#include "geometry/point_triangle_distance.h"

#include "geometry/nearest-inl.h"

#include <algorithm>

namespace abut {

TriangleFoot foot_within(const Vec3& p, const Triangle& t) {
    const auto foot = HWY_NAMESPACE::foot_on(p, t);
    if (!foot.within)
        return {};
    TriangleFoot result{true, foot.point, foot.gap, {}};
    result.weights[foot.first] = std::max(0.0, 1 - foot.g - foot.h);
    result.weights[(foot.first + 1) % 3] = foot.g;
    result.weights[(foot.first + 2) % 3] = foot.h;
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
