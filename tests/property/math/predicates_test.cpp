// Orientation signs equal those of rational arithmetic, for coordinates of every kind.

#include "math/predicates.h"
#include "tests/support/random.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <functional>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Rational = boost::multiprecision::cpp_rational;

struct RationalPoint {
    explicit RationalPoint(const Vec3& p) : v{Rational(p.x), Rational(p.y), Rational(p.z)} {}
    std::array<Rational, 3> v;
};

int sign(const Rational& r) {
    return (r > 0) - (r < 0);
}

/// The 4x4 determinant of the stored coordinates by cofactors, not of their differences.
int rational_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const RationalPoint p(a), q(b), r(c), s(d);
    const auto det = [](const RationalPoint& x, const RationalPoint& y, const RationalPoint& z) {
        return Rational(x.v[0] * (y.v[1] * z.v[2] - y.v[2] * z.v[1]) -
                        x.v[1] * (y.v[0] * z.v[2] - y.v[2] * z.v[0]) +
                        x.v[2] * (y.v[0] * z.v[1] - y.v[1] * z.v[0]));
    };
    return sign(Rational(det(q, r, s) - det(p, r, s) + det(p, q, s) - det(p, q, r)));
}

int rational_orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
    const RationalPoint p(a), q(b), r(c);
    const auto u = static_cast<std::size_t>((axis + 1) % 3),
               v = static_cast<std::size_t>((axis + 2) % 3);
    const auto area = [&](const RationalPoint& x, const RationalPoint& y) {
        return Rational(x.v[u] * y.v[v] - x.v[v] * y.v[u]);
    };
    return sign(Rational(area(p, q) + area(q, r) + area(r, p)));
}

using Points = std::array<Vec3, 4>;

double with_exponent(Random& random, int low, int high) {
    const double sign = random.chance(0.5) ? 1 : -1;
    return sign * std::ldexp(random.uniform(0.5, 1), random.integer(low, high));
}
Points with_exponents(Random& random, int low, int high) {
    Points p;
    for (Vec3& v : p) {
        v.x = with_exponent(random, low, high);
        v.y = with_exponent(random, low, high);
        v.z = with_exponent(random, low, high);
    }
    return p;
}
/// Moves the fourth point next to the plane of the others; if `line`, also the third next to the
/// line of the first two.
Points flattened(Random& random, Points p, bool line, int ulps) {
    const double s = random.uniform(-1, 2), t = random.uniform(-1, 2);
    if (line)
        p[2] = random.nudge(p[0] + s * (p[1] - p[0]), ulps);
    p[3] = random.nudge(p[0] + s * (p[1] - p[0]) + t * (p[2] - p[0]), ulps);
    return p;
}

struct Outcome {
    int zero = 0, positive = 0, negative = 0;
    std::uint64_t exact = 0; ///< signs decided by integers
};

Outcome compare(int cases, const std::function<Points()>& make) {
    Outcome outcome;
    const std::uint64_t before = exact_signs();
    for (int i = 0; i < cases; ++i) {
        const Points p = make();
        const int expected = rational_orient3d(p[0], p[1], p[2], p[3]);
        const int got = orient3d(p[0], p[1], p[2], p[3]);
        ++(got == 0 ? outcome.zero : got > 0 ? outcome.positive : outcome.negative);
        bool on_line = true;
        for (int axis = 0; axis < 3; ++axis) {
            const int flat = rational_orient2d(p[0], p[1], p[2], axis);
            EXPECT_EQ(orient2d(p[0], p[1], p[2], axis), flat);
            on_line = on_line && flat == 0;
        }
        EXPECT_EQ(got, expected);
        EXPECT_EQ(orient3d(p[1], p[0], p[2], p[3]), -expected);
        EXPECT_EQ(orient3d(p[2], p[3], p[0], p[1]), expected);
        EXPECT_EQ(collinear(p[0], p[1], p[2]), on_line);
        if (testing::Test::HasFailure()) {
            for (const Vec3& v : p)
                std::cout << std::hexfloat << v.x << ' ' << v.y << ' ' << v.z << '\n';
            break;
        }
    }
    outcome.exact = exact_signs() - before;
    return outcome;
}

TEST(Predicates, RandomCoordinates) {
    Random random(101);
    const Outcome o = compare(3000, [&] {
        return Points{random.in_cube(), random.in_cube(), random.in_cube(), random.in_cube()};
    });
    EXPECT_GT(o.positive, 1000);
    EXPECT_GT(o.negative, 1000);
    EXPECT_LT(o.exact, 30U); // the floating-point filter decides nearly all
}

TEST(Predicates, NearAPlane) {
    Random random(102);
    const Outcome o = compare(6000, [&] {
        const Points p{random.in_cube(), random.in_cube(), random.in_cube(), {}};
        return flattened(random, p, random.chance(0.3), 2);
    });
    EXPECT_GT(o.exact, 6000U);
    EXPECT_GT(o.positive, 1500);
    EXPECT_GT(o.negative, 1500);
}

TEST(Predicates, NearAPlaneFarFromTheOrigin) {
    Random random(103);
    const Outcome o = compare(3000, [&] {
        const Vec3 far = random.in_cube(1e6);
        Points p{far + random.in_cube(), far + random.in_cube(), far + random.in_cube(), {}};
        for (Vec3& v : p) // a binary grid: the fourth point is often exactly on the plane
            v = {std::round(v.x * 64) / 64, std::round(v.y * 64) / 64, std::round(v.z * 64) / 64};
        const int ulps = random.chance(0.5) ? 0 : 1;
        p[3] = random.nudge(p[0] + random.integer(-3, 3) * (p[1] - p[0]) +
                                random.integer(-3, 3) * (p[2] - p[0]),
                            ulps);
        return p;
    });
    EXPECT_GT(o.exact, 3000U);
    EXPECT_GT(o.zero, 1000);
    EXPECT_GT(o.positive, 500);
}

TEST(Predicates, Lattice) {
    Random random(104);
    const Outcome o = compare(6000, [&] {
        return Points{random.on_lattice(3), random.on_lattice(3), random.on_lattice(3),
                      random.on_lattice(3)};
    });
    EXPECT_GT(o.zero, 600);
    EXPECT_GT(o.positive, 1500);
    EXPECT_GT(o.exact, 600U);
}

TEST(Predicates, MixedExponents) {
    Random random(105);
    const Outcome o = compare(3000, [&] {
        Points p = with_exponents(random, -60, 60);
        return random.chance(0.5) ? flattened(random, p, random.chance(0.3), 1) : p;
    });
    EXPECT_GT(o.exact, 1000U);
}

TEST(Predicates, Overflow) {
    Random random(106);
    const Outcome o = compare(1000, [&] {
        if (random.chance(0.5))
            return with_exponents(random, 1000, 1023);
        // The point that is laid on the plane must not overflow either.
        return flattened(random, with_exponents(random, 1000, 1018), random.chance(0.3), 1);
    });
    EXPECT_GT(o.exact, 1000U);
}

TEST(Predicates, Underflow) {
    Random random(107);
    const Outcome o = compare(2000, [&] {
        const int top = random.chance(0.5) ? -1050 : -340; // subnormal coordinates, or products
                                                           // that vanish
        Points p = with_exponents(random, top - 20, top);
        return random.chance(0.5) ? flattened(random, p, random.chance(0.3), 1) : p;
    });
    EXPECT_GT(o.exact, 1000U);
}

TEST(Predicates, TheWholeRangeOfDoubles) {
    Random random(108);
    const Outcome o = compare(500, [&] { return with_exponents(random, -1073, 1023); });
    EXPECT_GT(o.positive, 150);
    EXPECT_GT(o.negative, 150);
}

TEST(Predicates, SharedPointsGiveZero) {
    Random random(109);
    const Outcome o = compare(500, [&] {
        Points p = with_exponents(random, -10, 10);
        const auto i = static_cast<std::size_t>(random.integer(0, 3));
        p[i] = p[(i + 1 + static_cast<std::size_t>(random.integer(0, 2))) % 4];
        return p;
    });
    EXPECT_EQ(o.zero, 500);
}

} // namespace
} // namespace abut::test
