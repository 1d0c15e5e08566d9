#include "view/simplify/shading.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Normals within 15 degrees have one shade: a light colour changes by at most 16 of 255 then.
constexpr double kCosSameShade = 0.9659258262890683;
/// The share of an area that is seen at once: the mean over all directions, of a convex surface.
constexpr double kSeen = 0.25;

double area_of(const Triangle& t) {
    return 0.5 * length(cross(t[1] - t[0], t[2] - t[0]));
}

} // namespace

double shading_error(const ShadedTriangles& surface, const ShadedTriangles& shown,
                     const TriangleSearch& search, double least, double most) {
    const auto error_of = [](double area) { return 0.5 * std::sqrt(kSeen * area); };
    double whole = 0;
    for (const Triangle& t : surface.triangles)
        whole += area_of(t);
    if (error_of(whole) <= least)
        return 0;
    double changed = 0;
    for (std::size_t i = 0; i < surface.size() && error_of(changed) <= most; ++i) {
        const Triangle& t = surface.triangles[i];
        const auto& [a, b, c] = surface.normals[i];
        const Vec3 middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
        const DistanceFace& face = search[search.nearest(middle).triangle];
        const std::array<double, 3> weights = face.weights(middle);
        Vec3 there;
        for (std::size_t k = 0; k < 3; ++k)
            there = there + weights.at(k) * shown.normals[face.number()].at(k);
        const double agrees =
            std::abs(dot(normalized_or_zero(a + b + c), normalized_or_zero(there)));
        if (agrees < kCosSameShade)
            changed += area_of(t);
    }
    const double error = error_of(changed);
    return error <= least ? 0 : error;
}

} // namespace abut
