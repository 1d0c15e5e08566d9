// Rays, spheres and boxes against one triangle, by independent computations.

#include "geometry/box_triangle_intersect.h"
#include "geometry/ray_triangle_intersect.h"
#include "geometry/sphere_triangle_intersect.h"
#include "math/dyadic.h"
#include "math/predicates.h"
#include "tests/support/oracle/exact_oracle.h"
#include "tests/support/oracle/precise_distance.h"
#include "tests/support/oracle/rational_clip.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Dyadic, EqualsRationals) {
    Random random(2001);
    const auto any = [&] {
        return random.chance(0.1) ? 0.0
                                  : std::ldexp(random.uniform(-1, 1), random.integer(-300, 300));
    };
    for (int i = 0; i < 3000; ++i) {
        const double a = any(), b = any(), c = any(), d = any();
        const Dyadic x = Dyadic(a) * Dyadic(b) - (Dyadic(c) + -Dyadic(d)) * Dyadic(a);
        const Rational y = Rational(a) * Rational(b) - (Rational(c) - Rational(d)) * Rational(a);
        ASSERT_EQ(x.sign(), y.sign());
        const Rational scale = Rational(c) + Rational(d);
        if (scale == 0)
            continue;
        const Rational exact = y / scale;
        const double rounded = quotient(x, Dyadic(c) + Dyadic(d));
        ASSERT_LE(abs(Rational(rounded) - exact), abs(exact) * Rational(0x1p-52)) << i;
    }
}

TEST(TurnAroundLine, EqualsRationals) {
    Random random(2002);
    int zero = 0;
    const int cases = 20000;
    for (int i = 0; i < cases; ++i) {
        Vec3 o, d, p, q;
        if (i % 2 == 0) {
            o = random.on_lattice(4), d = random.on_lattice(4) - Vec3{2, 2, 2};
            p = random.on_lattice(4), q = random.on_lattice(4);
        } else { // next to the plane through the line and p
            o = random.in_cube(), d = std::ldexp(1.0, random.integer(-40, 40)) * random.in_cube();
            p = random.in_cube();
            q = random.nudge(o + random.uniform(-2, 2) * (p - o) + random.uniform(0, 1) * d, 1);
        }
        const auto r = [](const Vec3& v) { return RationalVec3(v); };
        const Rational det = dot(r(d), cross(r(p) - r(o), r(q) - r(o)));
        ASSERT_EQ(turn_around_line(o, d, p, q), det.sign()) << i;
        zero += det == 0 ? 1 : 0;
    }
    EXPECT_GT(zero, cases / 20);
    EXPECT_LT(zero, cases * 9 / 10);
}

/// Rays with lattice points as ends: integers decide whether the segment meets the triangle.
TEST(RayTriangle, EqualsTheSegmentOnALattice) {
    Random random(2003);
    int hits = 0, along = 0;
    const int cases = 60000;
    for (int i = 0; i < cases; ++i) {
        const int size = i % 2 == 0 ? 3 : 5;
        Triangle t = random.lattice_triangle(size);
        if (i % 10 == 0)
            t[2] = t[random.integer(0, 1)]; // a segment or a point
        Vec3 d = random.on_lattice(4) - Vec3{2, 2, 2};
        if (d == Vec3{})
            d = {0, 0, 1};
        const Vec3 aim = t[static_cast<std::size_t>(random.integer(0, 2))];
        // Half of the rays pass through a vertex.
        const Vec3 o =
            random.chance(0.5) ? aim - double(random.integer(-2, 3)) * d : random.on_lattice(size);
        const double t_min = random.integer(-2, 1), t_max = t_min + random.integer(0, 5);
        const auto meets = [&](double begin, double end) {
            const std::array<Vec3, 2> segment{o + begin * d, o + end * d};
            return oracle_meet<BigInt>(segment, t);
        };
        const auto hit = ray_triangle_intersect({o, d, t_min, t_max}, t);
        ASSERT_EQ(hit.has_value(), meets(t_min, t_max)) << i;
        if (!hit)
            continue;
        ++hits, along += hit->side == 0 ? 1 : 0;
        // Nothing is met before the hit. Single-precision ends keep the coordinates exact.
        const auto before = double(float(hit->t - 1e-4)), after = double(float(hit->t + 1e-4));
        if (before >= t_min) {
            ASSERT_FALSE(meets(t_min, before)) << i;
        }
        ASSERT_TRUE(meets(std::min(t_min, before), after)) << i;
        ASSERT_TRUE(hit->t >= t_min && hit->t <= t_max);
        Vec3 on{};
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = hit_weights({o, d, t_min, t_max}, t, *hit)[k];
            ASSERT_GE(weight, 0);
            on = on + weight * t[k], sum += weight;
        }
        ASSERT_NEAR(sum, 1, 1e-12);
        ASSERT_LT(length(on - (o + hit->t * d)), 1e-12) << i;
        // The sign of n . d gives the side.
        const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
        ASSERT_EQ(hit->side, (dot(n, d) < 0) - (dot(n, d) > 0)) << i;
    }
    EXPECT_GT(hits, cases * 2 / 10);
    EXPECT_LT(hits, cases * 8 / 10);
    EXPECT_GT(along, hits / 50);
}

/// Rays of any size in doubles: whether they hit, t, and the order of hits, by rationals. No ray
/// lies in the plane of a triangle.
TEST(RayTriangle, EqualsRationals) {
    Random random(2004);
    int hits = 0, near_ties = 0;
    const int cases = 6000;
    for (int i = 0; i < cases; ++i) {
        const double scale = i % 3 == 0 ? 1e-6 : i % 3 == 1 ? 1 : 1e6;
        const Vec3 away = i % 2 == 0 ? Vec3{} : random.in_cube(1e5);
        std::array<Triangle, 2> triangles;
        for (Triangle& t : triangles) {
            t = random.triangle(scale);
            for (Vec3& p : t)
                p = p + away;
        }
        // The second triangle shares an edge with the first, or begins a few units in the last
        // place off it.
        triangles[1][0] = triangles[0][1];
        triangles[1][1] = random.chance(0.5) ? triangles[0][0] : random.nudge(triangles[0][0], 1);
        const double s = random.uniform(0, 1);
        const Vec3 on_edge = s * triangles[0][0] + (1 - s) * triangles[0][1];
        const Vec3 aim = random.chance(0.3) ? on_edge : away + random.in_cube(0.5 * scale);
        const Vec3 o = away + random.in_cube(3 * scale);
        const Vec3 d = std::ldexp(1.0, random.integer(-20, 20)) * (aim - o);
        const Ray ray{o, d, -kInfinity, kInfinity};
        std::array<std::optional<RayTriangleHit>, 2> hit;
        std::array<Rational, 2> exact;
        for (std::size_t k = 0; k < 2; ++k) {
            const Triangle& t = triangles[k];
            const RationalVec3 p(t[0]), u = RationalVec3(t[1]) - p, v = RationalVec3(t[2]) - p,
                                        w = RationalVec3(o) - p, e(d);
            const Rational det = dot(cross(u, v), e);
            ASSERT_NE(det, 0);
            // Solves p + g u + h v = o + t d.
            exact[k] = -dot(cross(u, v), w) / det;
            const RationalVec3 x{w.x + exact[k] * e.x, w.y + exact[k] * e.y, w.z + exact[k] * e.z};
            const RationalVec3 n = cross(u, v);
            const Rational h = dot(cross(u, x), n) / dot(n, n), g = dot(cross(x, v), n) / dot(n, n);
            const bool meets = g >= 0 && h >= 0 && g + h <= 1;
            hit[k] = ray_triangle_intersect(ray, t);
            ASSERT_EQ(hit[k].has_value(), meets) << i;
            if (!meets)
                continue;
            ++hits;
            ASSERT_LE(abs(Rational(hit[k]->t) - exact[k]), abs(exact[k]) * Rational(0x1p-40)) << i;
            // The range is exact: ends at t and next to t.
            const double t0 = hit[k]->t;
            for (const double end :
                 {std::nextafter(t0, -kInfinity), t0, std::nextafter(t0, kInfinity)}) {
                ASSERT_EQ(ray_triangle_intersect({o, d, end, kInfinity}, t).has_value(),
                          exact[k] >= Rational(end));
                ASSERT_EQ(ray_triangle_intersect({o, d, -kInfinity, end}, t).has_value(),
                          exact[k] <= Rational(end));
            }
        }
        if (hit[0] && hit[1]) {
            const Rational difference = exact[0] - exact[1];
            ASSERT_EQ(compare_hits(ray, triangles[0], *hit[0], triangles[1], *hit[1]),
                      difference.sign());
            near_ties += std::abs(hit[0]->t - hit[1]->t) < 1e-12 * std::abs(hit[0]->t) ? 1 : 0;
        }
    }
    EXPECT_GT(hits, cases * 2 / 10);
    EXPECT_LT(hits, 2 * cases * 8 / 10);
    EXPECT_GT(near_ties, 20);
}

TEST(SphereTriangle, EqualsAHundredDigits) {
    Random random(2005);
    int meet = 0, close = 0;
    const int cases = 15000;
    for (int i = 0; i < cases; ++i) {
        Triangle t;
        Vec3 centre;
        double scale = 1;
        if (i % 2 == 0) {
            t = random.lattice_triangle(4), centre = random.on_lattice(6);
            if (i % 20 == 0)
                t[1] = t[0];
        } else {
            scale = i % 3 == 0 ? 1e-6 : i % 3 == 1 ? 1 : 1e6;
            const Vec3 away = i % 5 == 0 ? random.in_cube(1e5 * scale) : Vec3{};
            t = random.triangle(scale);
            for (Vec3& p : t)
                p = p + away;
            centre = away + random.in_cube(2 * scale);
        }
        const Precise distance = precise_distance(centre, t);
        // The radius is next to the distance; on lattices it is often exactly the distance.
        const double radius = i % 4 < 3 ? std::abs(random.nudge(static_cast<double>(distance), 2))
                                        : random.uniform(0, 2 * scale);
        const bool expected = distance - Precise(radius) <= Precise(1e-80) * scale;
        ASSERT_EQ(sphere_triangle_intersect(centre, radius, t), expected) << i;
        meet += expected ? 1 : 0, close += distance == Precise(radius) ? 1 : 0;
    }
    EXPECT_GT(meet, cases * 3 / 10);
    EXPECT_LT(meet, cases * 8 / 10);
    EXPECT_GT(close, cases / 200);
}

TEST(BoxTriangle, EqualsClippingByRationals) {
    Random random(2006);
    int meet = 0;
    const int cases = 30000;
    for (int i = 0; i < cases; ++i) {
        const bool lattice = i % 3 != 0;
        const auto point = [&] { return lattice ? random.on_lattice(6) : random.in_cube(3); };
        Triangle t{point(), point(), point()};
        if (i % 10 == 0)
            t[2] = t[static_cast<std::size_t>(random.integer(0, 1))];
        if (i % 11 == 0) // on one line, or next to one
            t[2] = 0.5 * (t[0] + t[1]);
        Box3 box;
        const Vec3 p = point(), q = p + 0.4 * (point() - p);
        extend(box, p),
            extend(box, lattice ? Vec3{std::round(q.x), std::round(q.y), std::round(q.z)} : q);
        if (i % 4 == 1)
            box.upper.y = box.lower.y; // flat
        if (i % 8 == 1)
            box.upper.z = box.lower.z;
        if (!lattice && i % 2 == 0) { // a corner of the box is next to the triangle's plane
            const Vec3 on = random.nudge((1.0 / 3) * (t[0] + t[1] + t[2]), 1);
            const Vec3 size = box.upper - box.lower;
            box = {on, on + size};
        }
        const bool expected = clip_meets(t, rational_planes(box));
        ASSERT_EQ(box_triangle_intersect(box, t), expected) << i;
        meet += expected ? 1 : 0;
    }
    EXPECT_GT(meet, cases * 2 / 10);
    EXPECT_LT(meet, cases * 8 / 10);
}

} // namespace
} // namespace abut::test
