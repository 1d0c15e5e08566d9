#include "deform/bodies/way_out.h"

#include <algorithm>

namespace abut {

namespace {

constexpr int kMostSteps = 2000;
/// A nearest point of the hull that is nearer to the origin may be the origin itself.
constexpr double kLeastLength = 1e-2;

/// The normal that the vector leaves least.
const Vec3& least_left(std::span<const Vec3> normals, const Vec3& v) {
    return *std::min_element(normals.begin(), normals.end(),
                             [&](const Vec3& a, const Vec3& b) { return dot(a, v) < dot(b, v); });
}

/// The point of the segment from a to b that is nearest to the origin.
Vec3 nearest_of_segment(const Vec3& a, const Vec3& b) {
    const Vec3 side = b - a;
    const double square = length_sq(side);
    return square > 0 ? a + std::clamp(-dot(a, side) / square, 0.0, 1.0) * side : a;
}

} // namespace

Vec3 way_out(std::span<const Vec3> normals) {
    if (normals.empty())
        return {};
    Vec3 v = normals.front();
    for (int step = 0; step < kMostSteps; ++step) {
        const Vec3& least = least_left(normals, v);
        if (dot(least, v) >= 0.995 * length_sq(v))
            break;
        v = nearest_of_segment(v, least);
        if (!(length_sq(v) > kLeastLength * kLeastLength))
            return {};
    }
    const Vec3 unit = normalized_or_zero(v);
    return dot(least_left(normals, unit), unit) > 0 ? unit : Vec3{};
}

} // namespace abut
