// The exact intersection tests against the hull of the difference, in integers.

#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "tests/support/oracle/exact_oracle.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

struct Tally {
    std::array<int, 3> of{}; ///< by TriangleContact
    int degenerate = 0, coplanar = 0;
    [[nodiscard]] int pairs() const { return of[0] + of[1] + of[2]; }
    [[nodiscard]] double share(TriangleContact c) const {
        return double(of[static_cast<std::size_t>(c)]) / pairs();
    }
};

void print(const Triangle& t) {
    for (const Vec3& p : t)
        std::cout << std::hexfloat << '(' << p.x << ", " << p.y << ", " << p.z << ") ";
    std::cout << '\n';
}

template <typename Int>
void check(const Triangle& a, const Triangle& b, Tally& tally) {
    const TriangleContact expected = oracle_contact<Int>(a, b);
    ++tally.of[static_cast<std::size_t>(expected)];
    const bool degenerate = is_zero(oracle_normal<Int>(a)) || is_zero(oracle_normal<Int>(b));
    tally.degenerate += degenerate ? 1 : 0;
    tally.coplanar += !degenerate && orient3d(a[0], a[1], a[2], b[0]) == 0 &&
                              orient3d(a[0], a[1], a[2], b[1]) == 0 &&
                              orient3d(a[0], a[1], a[2], b[2]) == 0
                          ? 1
                          : 0;
    const TriangleContact got = triangle_triangle_intersect(a, b);
    if (got != expected) {
        print(a), print(b);
        FAIL() << "got " << int(got) << ", expected " << int(expected);
    }
}

void check_lattice(std::uint64_t seed, int n, int pairs, Tally& tally) {
    Random random(seed);
    for (int i = 0; i < pairs && !testing::Test::HasFailure(); ++i)
        check<long long>(random.lattice_triangle(n), random.lattice_triangle(n), tally);
}

// The lattice tests draw a million pairs together.
TEST(TriangleIntersect, LatticeOfFour) {
    Tally tally;
    check_lattice(301, 3, 600000, tally);
    EXPECT_GT(tally.share(TriangleContact::none), 0.3);
    EXPECT_GT(tally.share(TriangleContact::touch), 0.15);
    EXPECT_GT(tally.share(TriangleContact::cross), 0.05);
    EXPECT_GT(tally.degenerate, 60000);
    EXPECT_GT(tally.coplanar, 1000);
}
TEST(TriangleIntersect, LatticeOfThree) {
    Tally tally;
    check_lattice(302, 2, 200000, tally);
    EXPECT_GT(tally.share(TriangleContact::touch), 0.25);
    EXPECT_GT(tally.degenerate, 40000);
    EXPECT_GT(tally.coplanar, 1000);
}
TEST(TriangleIntersect, LatticeOfSix) {
    Tally tally;
    check_lattice(303, 5, 250000, tally);
    EXPECT_GT(tally.share(TriangleContact::none), 0.3);
    EXPECT_GT(tally.share(TriangleContact::touch), 0.05);
    EXPECT_GT(tally.share(TriangleContact::cross), 0.1);
}

/// All vertices lie in one oblique plane of the lattice: coplanar pairs of every kind.
TEST(TriangleIntersect, LatticePlane) {
    Random random(304);
    Tally tally;
    for (int i = 0; i < 100000 && !testing::Test::HasFailure(); ++i) {
        const auto point = [&] {
            const int u = random.integer(0, 4), v = random.integer(0, 4);
            return Vec3{double(u), double(v), double(2 * u - 3 * v)};
        };
        const Triangle a{point(), point(), point()}, b{point(), point(), point()};
        check<long long>(a, b, tally);
    }
    EXPECT_EQ(tally.of[2], 0);
    EXPECT_GT(tally.share(TriangleContact::none), 0.15);
    EXPECT_GT(tally.share(TriangleContact::touch), 0.3);
}

TEST(TriangleIntersect, RandomDoubles) {
    Random random(305);
    Tally tally;
    for (int i = 0; i < 6000 && !testing::Test::HasFailure(); ++i)
        check<BigInt>(random.triangle(), random.triangle(), tally);
    EXPECT_GT(tally.share(TriangleContact::none), 0.3);
    EXPECT_GT(tally.share(TriangleContact::cross), 0.1);
}

/// Pairs that nearly touch: a vertex, an edge or all of b is laid on a, then moved by some ulps.
TEST(TriangleIntersect, NearlyTouching) {
    Random random(306);
    Tally tally;
    const std::uint64_t before = exact_signs();
    for (int i = 0; i < 12000 && !testing::Test::HasFailure(); ++i) {
        // On a binary grid, points are laid on exactly; otherwise only to rounding.
        const bool grid = random.chance(0.5);
        Triangle a = random.triangle();
        for (Vec3& p : a)
            if (grid)
                p = {std::round(p.x * 64) / 64, std::round(p.y * 64) / 64,
                     std::round(p.z * 64) / 64};
        const auto on_a = [&] {
            // The point lies inside, on an edge, on a vertex, or a little outside.
            const double s = random.integer(-1, 8) / 8.0, t = random.integer(-1, 8) / 8.0;
            return random.nudge(a[0] + s * (a[1] - a[0]) + t * (1 - s) * (a[2] - a[0]),
                                grid && random.chance(0.7) ? 0 : 1);
        };
        Triangle b = random.triangle();
        const int laid = random.integer(1, 3);
        for (int k = 0; k < laid; ++k)
            b[static_cast<std::size_t>(k)] = on_a();
        check<AnyInt>(a, b, tally);
    }
    EXPECT_GT(exact_signs() - before, 10000U);
    EXPECT_GT(tally.share(TriangleContact::none), 0.1);
    EXPECT_GT(tally.share(TriangleContact::touch), 0.1);
    EXPECT_GT(tally.share(TriangleContact::cross), 0.05);
}

TEST(TriangleIntersect, SharedVerticesAndEdges) {
    Random random(307);
    Tally tally;
    for (int i = 0; i < 6000 && !testing::Test::HasFailure(); ++i) {
        const Triangle a = random.triangle();
        Triangle b = random.triangle();
        const int shared = random.integer(1, 3);
        for (int k = 0; k < shared; ++k)
            b[static_cast<std::size_t>(k)] = a[static_cast<std::size_t>((k + i) % 3)];
        check<BigInt>(a, b, tally);
        ASSERT_NE(triangle_triangle_intersect(a, b), TriangleContact::none);
    }
    EXPECT_GT(tally.share(TriangleContact::touch), 0.6);
    EXPECT_GT(tally.of[2], 50); // shared vertices of triangles that cross as well
}

TEST(TriangleIntersect, ExtremeMagnitudes) {
    Random random(308);
    Tally tally;
    for (int i = 0; i < 400 && !testing::Test::HasFailure(); ++i) {
        const int exponent = random.chance(0.5) ? 1018 : -1074;
        const auto scaled = [&](Triangle t) {
            for (Vec3& p : t)
                p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent),
                     std::ldexp(p.z, exponent)};
            return t;
        };
        const Triangle a = random.lattice_triangle(5), b = random.lattice_triangle(5);
        // Lattice coordinates scale exactly, so the answer must not change.
        ASSERT_EQ(triangle_triangle_intersect(scaled(a), scaled(b)),
                  triangle_triangle_intersect(a, b));
        check<AnyInt>(scaled(a), scaled(b), tally);
    }
    EXPECT_GT(tally.of[0], 50);
    EXPECT_GT(tally.of[1] + tally.of[2], 50);
}

TEST(TriangleIntersect, SymmetricAndFreeOfVertexOrder) {
    Random random(309);
    std::array<int, 3> seen{};
    for (int i = 0; i < 20000; ++i) {
        const bool lattice = i % 2 == 0;
        Triangle a = lattice ? random.lattice_triangle(3) : random.triangle(),
                 b = lattice ? random.lattice_triangle(3) : random.triangle();
        const TriangleContact expected = triangle_triangle_intersect(a, b);
        ++seen[static_cast<std::size_t>(expected)];
        ASSERT_EQ(triangle_triangle_intersect(b, a), expected);
        std::array<int, 3> order{0, 1, 2};
        const Triangle b_as_is = b;
        do {
            for (std::size_t k = 0; k < 3; ++k)
                b[k] = b_as_is[static_cast<std::size_t>(order[k])];
            ASSERT_EQ(triangle_triangle_intersect(a, b), expected);
            ASSERT_EQ(triangle_triangle_intersect(b, a), expected);
        } while (std::next_permutation(order.begin(), order.end()));
    }
    for (const int n : seen)
        EXPECT_GT(n, 1000);
}

TEST(SegmentIntersect, LatticeSegmentsAndTriangles) {
    Random random(310);
    int meets = 0, tried = 0, coplanar = 0;
    for (int i = 0; i < 300000; ++i) {
        const Triangle t = random.lattice_triangle(3);
        if (collinear(t[0], t[1], t[2]))
            continue;
        const std::array<Vec3, 2> s{random.on_lattice(3), random.on_lattice(3)};
        const bool expected = oracle_meet<long long>(s, t);
        ASSERT_EQ(segment_triangle_intersect(s[0], s[1], t), expected);
        ASSERT_EQ(segment_triangle_intersect(s[1], s[0], {t[2], t[0], t[1]}), expected);
        ++tried, meets += expected ? 1 : 0;
        coplanar += orient3d(t[0], t[1], t[2], s[0]) == 0 && orient3d(t[0], t[1], t[2], s[1]) == 0;
    }
    EXPECT_GT(meets, tried / 5);
    EXPECT_LT(meets, tried * 4 / 5);
    EXPECT_GT(coplanar, tried / 100);
}

TEST(SegmentIntersect, LatticeSegments) {
    Random random(311);
    int meets = 0;
    constexpr int kPairs = 300000;
    for (int i = 0; i < kPairs; ++i) {
        const std::array<Vec3, 2> a{random.on_lattice(2), random.on_lattice(2)},
            b{random.on_lattice(2), random.on_lattice(2)};
        const bool expected = oracle_meet<long long>(a, b);
        ASSERT_EQ(segment_segment_intersect(a[0], a[1], b[0], b[1]), expected);
        ASSERT_EQ(segment_segment_intersect(b[1], b[0], a[0], a[1]), expected);
        meets += expected ? 1 : 0;
    }
    EXPECT_GT(meets, kPairs / 10);
    EXPECT_LT(meets, kPairs * 9 / 10);
}

TEST(SegmentIntersect, NearlyTouchingDoubles) {
    Random random(312);
    int meets = 0;
    constexpr int kPairs = 10000;
    for (int i = 0; i < kPairs; ++i) {
        const std::array<Vec3, 2> a{random.in_cube(), random.in_cube()};
        // Binary fractions along a's line and beside it: often exact, otherwise off by an ulp.
        const double s = random.integer(-1, 9) / 8.0;
        std::array<Vec3, 2> b{random.nudge(a[0] + s * (a[1] - a[0]), random.integer(0, 1)),
                              random.in_cube()};
        const bool expected = oracle_meet<BigInt>(a, b);
        ASSERT_EQ(segment_segment_intersect(a[0], a[1], b[0], b[1]), expected);
        meets += expected ? 1 : 0;
        const Triangle t = random.triangle();
        b[0] = random.nudge((1.0 / 4) * t[0] + (1.0 / 4) * t[1] + (1.0 / 2) * t[2], 1);
        ASSERT_EQ(segment_triangle_intersect(b[0], b[1], t), oracle_meet<BigInt>(b, t));
    }
    EXPECT_GT(meets, kPairs / 20);
}

} // namespace
} // namespace abut::test
