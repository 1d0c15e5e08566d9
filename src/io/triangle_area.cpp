#include "io/triangle_area.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace abut {

namespace {

using Rational = boost::multiprecision::cpp_rational;

struct Triangle {
    Vec3 a, b, c;
};

/// One component of (b - a) x (c - a), seen along an axis: (bx - ax)(cy - ay) - (by - ay)(cx - ax).
///
/// Accuracy    true only if it is certainly not zero. Each of the four differences has a relative
/// error of at most u,
///             each product of (1 + u)^3 - 1 < 4u plus an underflow of at most 2^-1074, the
///             difference of u more: 8u times the sum of the products' sizes bounds the whole,
///             2^-1000 what underflows.
bool surely_not_zero(double ax, double ay, double bx, double by, double cx, double cy) {
    const double p = (bx - ax) * (cy - ay);
    const double q = (by - ay) * (cx - ax);
    constexpr double kBound = 8 * 0x1p-53;
    return std::fabs(p - q) > kBound * (std::fabs(p) + std::fabs(q)) + 0x1p-1000;
}

bool surely_has_area(const Triangle& t) {
    return surely_not_zero(t.a.x, t.a.y, t.b.x, t.b.y, t.c.x, t.c.y) ||
           surely_not_zero(t.a.y, t.a.z, t.b.y, t.b.z, t.c.y, t.c.z) ||
           surely_not_zero(t.a.z, t.a.x, t.b.z, t.b.x, t.c.z, t.c.x);
}

bool is_zero(double ax, double ay, double bx, double by, double cx, double cy) {
    return (Rational(bx) - ax) * (Rational(cy) - ay) == (Rational(by) - ay) * (Rational(cx) - ax);
}

bool has_area(const Triangle& t) {
    if (t.a == t.b || t.b == t.c || t.c == t.a)
        return false;
    return !is_zero(t.a.x, t.a.y, t.b.x, t.b.y, t.c.x, t.c.y) ||
           !is_zero(t.a.y, t.a.z, t.b.y, t.b.z, t.c.y, t.c.z) ||
           !is_zero(t.a.z, t.a.x, t.b.z, t.b.x, t.c.z, t.c.x);
}

template <typename Test>
bool any_triangle(const Scene& scene, const Test& test) {
    for (const Part& part : scene.parts) {
        const Mesh& mesh = scene.meshes[part.mesh];
        const auto world = [&](std::uint32_t vertex) {
            return world_position(part.world_from_mesh, mesh.positions[vertex]);
        };
        for (const auto& [a, b, c] : mesh.triangles)
            if (test(Triangle{world(a), world(b), world(c)}))
                return true;
    }
    return false;
}

} // namespace

bool any_triangle_has_area(const Scene& scene) {
    return any_triangle(scene, surely_has_area) || any_triangle(scene, has_area);
}

} // namespace abut
