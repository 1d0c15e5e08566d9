// Separating planes between models: models reported apart are apart, and most models that are apart
// are reported.

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "rigid/pair/separating_plane.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "volume/support_bound.h"

#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

/// Points that fill space, a plane, a line or a point; some lie far away.
std::vector<Vec3> cloud(Random& random) {
    const int dimensions = random.integer(0, 3);
    const Vec3 u = random.direction(), v = random.direction(), w = random.direction();
    const double size = std::ldexp(1.0, random.integer(-60, 40));
    const Vec3 at = random.chance(0.3) ? 1e6 * size * random.direction() : Vec3{};
    // A tenth of the clouds are large.
    const int most = random.chance(0.9) ? 40 : 1000;
    std::vector<Vec3> points(static_cast<std::size_t>(random.integer(1, most)));
    for (Vec3& p : points) {
        const Vec3 s = random.in_cube(size);
        p = at;
        if (dimensions > 0)
            p = p + s.x * u;
        if (dimensions > 1)
            p = p + s.y * v;
        if (dimensions > 2)
            p = p + s.z * w;
    }
    return points;
}

/// A random direction; half of them have equal or zero coordinates.
Vec3 any_direction(Random& random) {
    if (random.chance(0.5))
        return random.direction();
    const Vec3 n = random.on_lattice(4);
    return {n.x - 2, n.y - 2, n.z - 2};
}

TEST(SupportBound, NoPointReachesFarther) {
    Random random(2301);
    int tight = 0, cases = 0;
    for (int i = 0; i < many(4000); ++i) {
        const std::vector<Vec3> points = cloud(random);
        const SupportBound bound(points);
        for (int k = 0; k < 10; ++k) {
            const Vec3 n = any_direction(random);
            double most = -HUGE_VAL;
            for (const Vec3& p : points)
                most = std::max(most, dot(n, p - bound.middle()));
            const double rounding = 0x1p-49 * bound.size() * sum_of_sizes(n);
            ASSERT_GE(bound.height(n), most - rounding);
            ASSERT_NEAR(dot(n, bound.support(n)), bound.height(n), rounding);
            ++cases;
            tight += bound.height(n) - most <= 0.1 * bound.size() * length(n) ? 1 : 0;
        }
    }
    std::cout << tight << " tight of " << cases << '\n';
    EXPECT_GT(tight, cases * 9 / 10);
}

TEST(SupportBound, IsExactAlongItsNormals) {
    Random random(2302);
    for (int i = 0; i < many(500); ++i) {
        const std::vector<Vec3> points = cloud(random);
        const SupportBound bound(points);
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z) {
                    const Vec3 n{double(x), double(y), double(z)};
                    double most = -HUGE_VAL;
                    for (const Vec3& p : points)
                        most = std::max(most, dot(n, p - bound.middle()));
                    // The bound is rounded up, in single precision.
                    ASSERT_GE(bound.height(n), most);
                    ASSERT_NEAR(bound.height(n), most, 0x1p-20 * bound.size());
                }
    }
}

Mesh soup(Random& random, double size) {
    Mesh mesh;
    const int count = random.integer(1, 8);
    const bool flat = random.chance(0.2);
    for (int i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = random.in_cube(size);
            mesh.positions.push_back(flat ? Vec3{p.x, p.y, 0} : p);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

double distance_by_force(const Model& a, const Transform& world_from_a, const Model& b,
                         const Transform& world_from_b) {
    double best_sq = HUGE_VAL;
    for (std::uint32_t i = 0; i < a.mesh().triangles.size(); ++i)
        for (std::uint32_t j = 0; j < b.mesh().triangles.size(); ++j) {
            const Triangle s = a.data().world_triangle(i, world_from_a),
                           t = b.data().world_triangle(j, world_from_b);
            if (triangle_triangle_intersect(s, t) != TriangleContact::none)
                return 0;
            best_sq = std::min(best_sq, triangle_triangle_distance(s, t).distance_sq);
        }
    return std::sqrt(best_sq);
}

/// A third of them are rigid, a third affine, a third singular up to rounding.
Transform any_transform(Random& random, double reach) {
    const int kind = random.integer(0, 2);
    Transform t = random.linear_map(kind != 0);
    if (kind == 2)
        for (std::size_t i = 0; i < 3; ++i)
            t.m[6 + i] = 0.5 * t.m[i] - 2 * t.m[3 + i];
    const Vec3 at = random.in_cube(reach);
    t.m[9] = at.x, t.m[10] = at.y, t.m[11] = at.z;
    return t;
}

TEST(SeparatingPlane, ModelsReportedApartAreApart) {
    Random random(2303);
    int apart = 0, told = 0, near = 0;
    for (int i = 0; i < many(20000); ++i) {
        const double size = std::ldexp(1.0, random.integer(-40, 40));
        const Model a(soup(random, size)), b(soup(random, size));
        Transform world_from_a = any_transform(random, 4 * size),
                  world_from_b = any_transform(random, 4 * size);
        if (random.chance(0.2)) { // far from the origin, together
            const Vec3 away = 1e5 * size * random.direction();
            for (Transform* t : {&world_from_a, &world_from_b})
                t->m[9] += away.x, t->m[10] += away.y, t->m[11] += away.z;
        }
        const double distance = distance_by_force(a, world_from_a, b, world_from_b);
        const double share = random.uniform(0, 1.2);
        const double gap = random.chance(0.3) ? 0 : share * distance;
        const bool far = far_apart(a.data(), world_from_a, b.data(), world_from_b, gap);
        // The distance is rounded, so a slightly larger gap must never be reported.
        ASSERT_FALSE(far && !(distance > gap)) << "distance " << distance << ", gap " << gap;
        ASSERT_FALSE(
            far_apart(a.data(), world_from_a, b.data(), world_from_b, distance * (1 + 1e-12)));
        apart += distance > gap ? 1 : 0;
        told += far ? 1 : 0;
        near += distance == 0 ? 1 : 0;
    }
    std::cout << told << " of " << apart << " told apart, " << near << " meet\n";
    EXPECT_GT(told, apart / 2);
    EXPECT_GT(near, many(20000) / 40);
}

TEST(SeparatingPlane, IsExactForBoxesToSinglePrecision) {
    const Model box(box_mesh({-1, -1, -1}, {1, 1, 1}));
    for (const double gap : {1e-3, 0.5, 1e3}) {
        const Transform there = Pose{{0, 2 + gap, 0}};
        EXPECT_TRUE(far_apart(box.data(), {}, box.data(), there, gap - 0x1p-18));
        EXPECT_FALSE(far_apart(box.data(), {}, box.data(), there, there.m[10] - 2));
    }
    EXPECT_FALSE(far_apart(box.data(), {}, box.data(), Pose{{0, 2, 0}}, 0));
    EXPECT_FALSE(far_apart(box.data(), {}, box.data(), Pose{{2, 2, 0}}, 0));
}

TEST(SeparatingPlane, SaysNothingForExtremeNumbers) {
    const Model box(box_mesh({-1, -1, -1}, {1, 1, 1})), none(Mesh{});
    const Transform away = Pose{{10, 0, 0}};
    ASSERT_TRUE(far_apart(box.data(), {}, box.data(), away, 1));
    EXPECT_FALSE(far_apart(box.data(), {}, none.data(), away, 1));
    EXPECT_FALSE(far_apart(box.data(), {}, box.data(), away, HUGE_VAL));
    for (const double bad : {double{NAN}, double{HUGE_VAL}, -double{HUGE_VAL}})
        for (std::size_t i = 0; i < 12; ++i) {
            Transform t = away;
            t.m[i] = bad;
            EXPECT_FALSE(far_apart(box.data(), {}, box.data(), t, 1));
            EXPECT_FALSE(far_apart(box.data(), t, box.data(), {}, 1));
        }
    // Sizes whose squares overflow or underflow: boxes of different sizes that meet near the
    // origin.
    for (const double size : {1e-300, 1e-200, 1e-160, 1e160, 1e300})
        for (const double other : {0.5, 1.0})
            EXPECT_FALSE(far_apart(
                box.data(), Transform({size, 0, 0, 0, size, 0, 0, 0, size, 0, 0, 0}), box.data(),
                Transform({other * size, 0, 0, 0, size, 0, 0, 0, size, 0.1 * size, 0, 0}), 0));
}

} // namespace
} // namespace abut::test
