// Distances against 100 digits. Errors are in units of 2^-53 times the largest difference of
// coordinates.

#include "geometry/triangle_triangle_distance.h"
#include "tests/support/oracle/precise_distance.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Largest allowed error, in roundings.
constexpr double kRoundings = 16;

/// Shapes of the pairs that a test draws.
enum class Shape { any, thin, needle, flat_pair, lattice, collapsed, near, near_thin, far };

Triangle thin(Random& random, double width) {
    const Triangle t = random.triangle();
    return {t[0], t[1], t[0] + random.uniform(-0.5, 1.5) * (t[1] - t[0]) + random.in_cube(width)};
}

std::pair<Triangle, Triangle> pair_of(Random& random, Shape shape) {
    const double tiny = std::pow(10, random.uniform(-17, -1));
    Triangle a = random.triangle(), b = random.triangle();
    switch (shape) {
    case Shape::any:
        break;
    case Shape::thin:
        a = thin(random, tiny), b = thin(random, std::pow(10, random.uniform(-17, -1)));
        break;
    case Shape::needle: // two needles next to each other, almost parallel
        a = thin(random, tiny);
        for (std::size_t i = 0; i < 3; ++i)
            b[i] = a[(i + 1) % 3] + random.in_cube(tiny);
        break;
    case Shape::flat_pair: { // almost in one plane
        for (std::size_t i = 0; i < 3; ++i) {
            a[i].z *= tiny, b[i].z *= tiny;
            b[i].x += random.chance(0.7) ? 2 : 0;
        }
        break;
    }
    case Shape::lattice:
        a = random.lattice_triangle(3), b = random.lattice_triangle(3);
        break;
    case Shape::collapsed:
        a[2] = random.chance(0.5) ? a[0] : 0.5 * (a[0] + a[1]);
        if (random.chance(0.5))
            a[1] = a[0];
        if (random.chance(0.3))
            b[2] = b[1];
        break;
    case Shape::near_thin:
        a = thin(random, std::pow(10, random.uniform(-17, -1)));
        [[fallthrough]];
    case Shape::near: { // one vertex or edge of b just off a
        const double s = random.uniform(0, 1), t = random.uniform(0, 1 - s);
        b[0] = a[0] + s * (a[1] - a[0]) + t * (a[2] - a[0]) + random.in_cube(tiny);
        break;
    }
    case Shape::far: {
        const Vec3 away = random.in_cube(1e5);
        for (std::size_t i = 0; i < 3; ++i)
            a[i] = a[i] + away, b[i] = b[i] + away;
        break;
    }
    }
    return {a, b};
}

class TriangleDistance : public testing::TestWithParam<Shape> {};

TEST_P(TriangleDistance, IsExactToRounding) {
    Random random(400 + static_cast<std::uint64_t>(GetParam()));
    double worst = 0, worst_points = 0;
    int apart = 0;
    constexpr int kPairs = 400;
    for (int i = 0; i < kPairs; ++i) {
        const auto [a, b] = pair_of(random, GetParam());
        const double unit = 0x1p-53 * size_of(a, b);
        const Precise truth = precise_distance(a, b);
        apart += truth > 0 ? 1 : 0;
        const ClosestPoints c = triangle_triangle_distance(a, b);
        // Doubles may fail to see a crossing; then the distance is that of the boundaries.
        const auto error_of = [&](double d) {
            double e = std::abs(double(Precise(d) - truth));
            if (truth == 0)
                e = std::min(e, std::abs(double(Precise(d) - precise_boundary_distance(a, b))));
            return e / unit;
        };
        const double error = error_of(std::sqrt(c.distance_sq));
        worst = std::max(worst, error);
        // The witness points lie on their triangles, at the reported distance. They are rounded to
        // the grid of the coordinates, which may be coarser than that of their differences.
        double largest = 0;
        for (std::size_t k = 0; k < 3; ++k)
            for (const Vec3& p : {a[k], b[k]})
                largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        const double grid = 0x1p-53 * largest;
        const double off =
            std::max({double(precise_distance(c.a, a)), double(precise_distance(c.b, b)),
                      std::abs(length(c.a - c.b) - std::sqrt(c.distance_sq))});
        // If two needles in almost one plane cross, their common point is ill-conditioned.
        const double points_bound = truth > 0 ? kRoundings * grid : 1e-8 * size_of(a, b);
        if (truth > 0)
            worst_points = std::max(worst_points, off / grid);
        if (error > kRoundings || off > points_bound) {
            for (const Triangle& t : {a, b})
                for (const Vec3& p : t)
                    std::cout << std::hexfloat << '{' << p.x << ", " << p.y << ", " << p.z << "}, ";
            FAIL() << "distance " << std::sqrt(c.distance_sq) << ", truth " << double(truth)
                   << ", off by " << error << " roundings; points by " << off / grid;
        }
        EXPECT_LE(error_of(std::sqrt(triangle_triangle_distance(b, a).distance_sq)), kRoundings);
    }
    std::cout << "worst " << worst << " roundings, points " << worst_points << '\n';
    EXPECT_GT(apart, kPairs / 10);
}

INSTANTIATE_TEST_SUITE_P(Shapes, TriangleDistance,
                         testing::Values(Shape::any, Shape::thin, Shape::needle, Shape::flat_pair,
                                         Shape::lattice, Shape::collapsed, Shape::near,
                                         Shape::far));

TEST(SegmentDistance, IsExactToRoundingAtEveryAngle) {
    Random random(420);
    double worst = 0;
    for (int i = 0; i < 6000; ++i) {
        const Vec3 p0 = random.in_cube(), p1 = i % 10 == 0 ? p0 : random.in_cube();
        // The angle is anything from almost 0 to a right angle, at any offset.
        const double turn = std::pow(10, random.uniform(-17, 0)),
                     gap = std::pow(10, random.uniform(-17, 0));
        const Vec3 q0 = p0 + random.uniform(-1, 1) * (p1 - p0) + random.in_cube(gap);
        const Vec3 q1 =
            i % 13 == 0 ? q0 : q0 + random.uniform(-2, 2) * (p1 - p0) + random.in_cube(turn);
        const Precise truth =
            precise_root(segment_segment_sq(precise(p0), precise(p1), precise(q0), precise(q1)));
        const ClosestPoints c = segment_segment_distance(p0, p1, q0, q1);
        const double unit = 0x1p-53 * size_of({p0, p1, q0}, {q1, q1, q1});
        const double error = std::abs(double(Precise(std::sqrt(c.distance_sq)) - truth));
        if (unit > 0)
            worst = std::max(worst, error / unit);
        ASSERT_LE(error, kRoundings * unit)
            << std::hexfloat << p0.x << ' ' << p0.y << ' ' << p0.z << ", " << p1.x << ' ' << p1.y
            << ' ' << p1.z << ", " << q0.x << ' ' << q0.y << ' ' << q0.z << ", " << q1.x << ' '
            << q1.y << ' ' << q1.z;
    }
    std::cout << "worst " << worst << " roundings\n";
}

TEST(PointTriangleDistance, IsExactToRounding) {
    Random random(421);
    double worst = 0;
    int inside = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto [t, other] = pair_of(random, static_cast<Shape>(i % 9));
        const Vec3 p = other[0];
        const ClosestPoints c = point_triangle_distance(p, t);
        EXPECT_EQ(c.a, p);
        const double unit = 0x1p-53 * size_of({p, p, p}, t);
        const double error =
            std::abs(double(Precise(std::sqrt(c.distance_sq)) - precise_distance(p, t)));
        worst = std::max(worst, unit > 0 ? error / unit : 0);
        ASSERT_LE(error, kRoundings * unit) << "shape " << i % 9;
        const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
        inside += std::abs(dot(p - c.b, n)) > 0.999 * length(p - c.b) * length(n) ? 1 : 0;
    }
    std::cout << "worst " << worst << " roundings\n";
    EXPECT_GT(inside, 100);
}

} // namespace
} // namespace abut::test
