#include "ccd/difference_patch.h"

#include <algorithm>

namespace abut {

namespace {

/// Divides a vector by its largest coordinate, so that its square neither overflows nor underflows.
Vec3 scaled_down(const Vec3& v) {
    const double largest = max_abs(v);
    return largest > 0 ? Vec3{v.x / largest, v.y / largest, v.z / largest} : Vec3{};
}

/// An eighth of the velocity of the second feature's point of impact relative to the first's. The
/// factor prevents overflow.
Vec3 relative_velocity(const ElementaryPair& pair, const std::array<double, 3>& b) {
    const auto way = [&](std::size_t i) { return 0.125 * pair.end[i] - 0.125 * pair.start[i]; };
    if (pair.kind == ElementaryKind::vertex_face)
        return b[0] * (way(1) - way(0)) + b[1] * (way(2) - way(0)) + b[2] * (way(3) - way(0));
    return (1 - b[1]) * way(2) + b[1] * way(3) - ((1 - b[0]) * way(0) + b[0] * way(1));
}

} // namespace

std::array<double, 3> patch_barycentric(ElementaryKind kind, double x, double y) {
    x = std::clamp(x, 0.0, 1.0);
    y = std::clamp(y, 0.0, 1.0);
    if (kind == ElementaryKind::edge_edge)
        return {x, y, 0};
    const double sum = x + y;
    if (sum > 1)
        x /= sum, y /= sum;
    return {std::max(0.0, 1 - (x + y)), x, y};
}

Vec3 impact_normal(const ElementaryPair& pair, const std::array<double, 3>& barycentric,
                   const Vec3& direction, const Vec3& line) {
    // The second feature approaches the first along the normal.
    const Vec3 velocity = scaled_down(relative_velocity(pair, barycentric));
    Vec3 n = normalized_or_zero(scaled_down(direction));
    if (n == Vec3{}) {
        const Vec3 along = normalized_or_zero(scaled_down(line));
        n = normalized_or_zero(velocity - dot(velocity, along) * along);
    }
    return dot(n, velocity) < 0 ? -n : n;
}

} // namespace abut
