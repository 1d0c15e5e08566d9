// The nearest point of a simplex with 106 bits, against rational numbers; and what doubles lose.

#include "convex/support/nearest_simplex.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Number = boost::multiprecision::cpp_bin_float_100;
using Point = std::array<Number, 3>;

Point precise(const Vec3& v) {
    return {Number(v.x), Number(v.y), Number(v.z)};
}
Point difference(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Number product(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point along(const Point& p, const Number& s, const Point& u) {
    return {p[0] + s * u[0], p[1] + s * u[1], p[2] + s * u[2]};
}

/// The nearest point of a triangle to the origin: the foot in its plane if it is inside, else the
/// nearest of its edges.
Point nearest_of_triangle(const std::array<Vec3, 3>& corners) {
    const Point p = precise(corners[0]), u = difference(precise(corners[1]), p),
                v = difference(precise(corners[2]), p);
    const Number uu = product(u, u), uv = product(u, v), vv = product(v, v), pu = -product(p, u),
                 pv = -product(p, v), area = uu * vv - uv * uv;
    const Number s = vv * pu - uv * pv, t = uu * pv - uv * pu;
    if (area > 0 && s > 0 && t > 0 && s + t < area)
        return along(along(p, s / area, u), t / area, v);
    Point best = p;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point q = precise(corners[i]), way = difference(precise(corners[(i + 1) % 3]), q);
        const Number all = product(way, way), part = -product(q, way);
        const Number share = !(part > 0) ? Number(0) : !(part < all) ? Number(1) : part / all;
        const Point at = along(q, share, way);
        if (product(at, at) < product(best, best))
            best = at;
    }
    return best;
}

SupportSimplex simplex_of(const std::array<Vec3, 3>& corners) {
    SupportSimplex simplex;
    simplex.count = 3;
    for (std::size_t i = 0; i < 3; ++i)
        simplex.corners[i].at = corners[i];
    return simplex;
}

TEST(NearestSimplex, ThinTrianglesHaveAnAccuratePointAndDirection) {
    Random random(7301);
    int inside = 0, lost = 0;
    for (int round = 0; round < many(2000); ++round) {
        // A long and thin triangle, whose plane passes near the origin.
        const double thin = std::pow(10, -random.uniform(2, 8));
        const Vec3 n = random.direction(), u = perpendicular(n), v = cross(n, u),
                   foot = std::pow(10, -random.uniform(3, 12)) * n;
        const Vec3 p = foot + random.uniform(0.2, 1) * u + random.uniform(0, thin) * v,
                   q = foot + random.uniform(0.2, 1) * u - random.uniform(0, thin) * v,
                   r = foot - random.uniform(0.2, 1) * u + random.uniform(-thin, thin) * v;
        const std::array<Vec3, 3> corners{p, q, r};
        const Point expected = nearest_of_triangle(corners);
        const double distance = double(sqrt(product(expected, expected)));
        SupportSimplex exactly = simplex_of(corners), plain = exactly;
        const auto found = reduce_to_nearest_precisely(exactly);
        const auto lossy = reduce_to_nearest(plain);
        ASSERT_TRUE(found && lossy);
        const Vec3 at{double(expected[0]), double(expected[1]), double(expected[2])};
        EXPECT_LE(length(found->at - at), 1e-9 * distance) << round;
        inside += exactly.count == 3 ? 1 : 0;
        lost += length(*lossy - at) > 1e-3 * distance ? 1 : 0;
    }
    EXPECT_GT(inside, many(2000) / 20);
    EXPECT_GT(lost, many(2000) / 50); // so that the digits are needed
}

TEST(NearestSimplex, ATetrahedronHoldsTheOriginOnlyIfThatIsCertain) {
    Random random(7302);
    int holds = 0;
    for (int round = 0; round < many(1000); ++round) {
        SupportSimplex simplex;
        simplex.count = 4;
        for (auto& corner : simplex.corners)
            corner.at = random.in_cube(1);
        // In half of the cases, one face passes through the origin: it holds it in no inside.
        const bool on_face = round % 2 == 0;
        if (on_face)
            simplex.corners[2].at = -0.5 * (simplex.corners[0].at + simplex.corners[1].at);
        const auto volume = [&](std::size_t i, std::size_t k, std::size_t l) {
            const Point a = precise(simplex.corners[i].at), b = precise(simplex.corners[k].at),
                        c = precise(simplex.corners[l].at);
            return Number(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                          a[2] * (b[0] * c[1] - b[1] * c[0]));
        };
        const std::array<Number, 4> volumes{volume(1, 2, 3), -volume(0, 2, 3), volume(0, 1, 3),
                                            -volume(0, 1, 2)};
        int positive = 0, negative = 0;
        for (const Number& each : volumes)
            positive += each > 1e-20 ? 1 : 0, negative += each < -1e-20 ? 1 : 0;
        const auto found = reduce_to_nearest_precisely(simplex);
        EXPECT_EQ(!found, positive == 4 || negative == 4) << round;
        holds += found ? 0 : 1;
    }
    EXPECT_GT(holds, many(1000) / 40);
}

} // namespace
} // namespace abut::test
