#include "geometry/sphere_triangle_intersect.h"

#include "geometry/point_triangle_distance.h"
#include "math/dyadic.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

enum class Decision { yes, no, open };

double largest_coordinate(const Vec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

Decision decide(const Vec3& centre, double radius, const Triangle& t) {
    // kRounding is far above the rounding of sums of a few terms, and far below any size that
    // matters. kTiny covers underflow.
    constexpr double kRounding = 0x1p-46, kTiny = 1e-150;
    const NearestOnTriangle nearest = nearest_on_triangle(centre, t);
    const double distance = std::sqrt(nearest.distance_sq);
    double size = largest_coordinate(centre);
    for (const Vec3& p : t)
        size = std::max(size, largest_coordinate(p));
    // The computed weights belong to some point of the triangle, whether or not it is the nearest.
    // So the triangle is no farther away than this.
    if (distance + kRounding * size + kTiny < radius)
        return Decision::yes;
    // A plane perpendicular to the gap: no point of the triangle is nearer to it than the nearest
    // vertex.
    const Vec3 gap = centre - nearest.point;
    const double length_of_gap = length(gap);
    double least = HUGE_VAL, reach = 0;
    for (const Vec3& p : t) {
        least = std::min(least, dot(gap, centre - p));
        reach = std::max(reach, length(centre - p));
    }
    if (least - kRounding * length_of_gap * (reach + radius) - kTiny > radius * length_of_gap)
        return Decision::no;
    return Decision::open;
}

bool exactly(const Vec3& centre, double radius, const Triangle& t) {
    const Dyadic r(radius), r_sq = r * r;
    const DyadicVec3 p(centre);
    const std::array v{DyadicVec3(t[0]), DyadicVec3(t[1]), DyadicVec3(t[2])};
    const auto at_most = [](const Dyadic& a, const Dyadic& b) { return (a - b).sign() <= 0; };
    for (const DyadicVec3& vertex : v)
        if (const DyadicVec3 w = p - vertex; at_most(dot(w, w), r_sq))
            return true;
    for (std::size_t i = 0; i < 3; ++i) {
        const DyadicVec3 edge = v[(i + 1) % 3] - v[i], w = p - v[i];
        const Dyadic along = dot(w, edge), edge_sq = dot(edge, edge);
        if (along.sign() > 0 && (edge_sq - along).sign() > 0 &&
            at_most(dot(w, w) * edge_sq - along * along, r_sq * edge_sq))
            return true;
    }
    const DyadicVec3 n = cross(v[1] - v[0], v[2] - v[0]);
    const Dyadic n_sq = dot(n, n);
    if (n_sq.sign() == 0)
        return false;
    for (std::size_t i = 0; i < 3; ++i)
        if (dot(cross(v[(i + 1) % 3] - v[i], p - v[i]), n).sign() < 0)
            return false;
    const Dyadic height = dot(p - v[0], n);
    return at_most(height * height, r_sq * n_sq);
}

} // namespace

bool sphere_triangle_intersect(const Vec3& centre, double radius, const Triangle& t) {
    const Decision decision = decide(centre, radius, t);
    return decision == Decision::open ? exactly(centre, radius, t) : decision == Decision::yes;
}

} // namespace abut
