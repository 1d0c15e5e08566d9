// Answers for convex bodies at the limit of floating point, against exact integers: thin hulls,
// needles, shallow overlaps, touching bodies. Status `exact` must be right for every shape.

#include <abut/convex.h>
#include <abut/rigid.h>

#include "convex/body/convex_data.h"
#include "convex/hull/exact_hull.h"
#include "tests/support/oracle/difference_oracle.h"
#include "tests/support/oracle/precise_distance.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace abut::test {
namespace {

/// All points of a body, placed, including those that its polytope leaves out.
std::vector<Vec3> placed_inputs(const Convex& body, const Transform& world) {
    std::vector<Vec3> points;
    for (const Vec3& p : body.vertices())
        points.push_back(apply(world, p));
    for (const Vec3& p : body.data().left_out)
        points.push_back(apply(world, p));
    return points;
}

Precise precise_distance_of_hulls(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    const HullSurface hull_a = exact_hull(a), hull_b = exact_hull(b);
    Precise least = -1;
    for (const IndexTriangle& s : hull_a.triangles)
        for (const IndexTriangle& t : hull_b.triangles) {
            const Precise d =
                precise_boundary_distance({a[s[0]], a[s[1]], a[s[2]]}, {b[t[0]], b[t[1]], b[t[2]]});
            if (least < 0 || d < least)
                least = d;
        }
    return least;
}

double extent_of(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double extent = 0;
    for (const auto* side : {&a, &b})
        for (const Vec3& p : *side)
            extent = std::max(extent, length(p));
    return extent;
}

struct Counts {
    int meet = 0, apart = 0, touch = 0, measured = 0;
};

/// Checks every claim of both queries, with and without a warm start, against the oracle.
void check(const Convex& a, const Transform& world_a, const Convex& b, const Transform& world_b,
           ConvexWarmStart* warm_start, bool measure, Counts& counts) {
    const std::vector<Vec3> pa = placed_inputs(a, world_a), pb = placed_inputs(b, world_b);
    const DifferenceOracle oracle(pa, pb);
    if (!oracle.is_solid())
        return;
    ++(oracle.meet() ? counts.meet : counts.apart);
    counts.touch += oracle.touch() ? 1 : 0;
    const double rounding = 0x1p-44 * extent_of(pa, pb), doubt = 0x1p-41 * extent_of(pa, pb);
    const ConvexGap gap = distance(a, world_a, b, world_b, {.warm_start = warm_start});
    ASSERT_EQ(gap.status, Status::exact);
    ASSERT_EQ(gap.distance == 0, oracle.meet()) << gap.distance;
    ASSERT_EQ(gap.at_least > 0, gap.distance > 0) << gap.distance;
    ASSERT_LE(gap.at_least, gap.distance);
    ASSERT_GE(gap.at_least, gap.distance * (1 - 1e-12) - doubt);
    if (gap.distance > 0 && measure) {
        const Precise truth = precise_distance_of_hulls(pa, pb);
        ASSERT_LE(gap.at_least, truth);
        ASSERT_LE(abs(truth - gap.distance), 1e-12 * gap.distance + rounding);
        ++counts.measured;
    }
    const ConvexDepth depth = penetration(a, world_a, b, world_b, {.warm_start = warm_start});
    ASSERT_EQ(depth.meet, oracle.meet());
    ASSERT_EQ(depth.status, Status::exact);
    if (!depth.meet) {
        ASSERT_EQ(depth.depth, 0);
        return;
    }
    ASSERT_LE(depth.at_least, oracle.depth() * (1 + 1e-15));
    ASSERT_LE(depth.at_least, depth.depth);
    ASSERT_NEAR(depth.depth, oracle.depth(), 1e-12 * oracle.depth() + rounding);
    ASSERT_GE(depth.at_least, depth.depth * (1 - 1e-12) - doubt);
    ASSERT_NEAR(length(depth.direction), 1, 1e-12);
}

void check_both_ways(const Convex& a, const Transform& world_a, const Convex& b,
                     const Transform& world_b, ConvexWarmStart& warm_start, bool measure,
                     Counts& counts) {
    check(a, world_a, b, world_b, nullptr, measure, counts);
    check(a, world_a, b, world_b, &warm_start, measure, counts);
}

std::vector<Vec3> points_in(Random& random, const Vec3& half) {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i) {
        const Vec3 p = random.in_cube(1);
        points.push_back({half.x * p.x, half.y * p.y, half.z * p.z});
    }
    return points;
}

void expect_both(const Counts& counts, int cases) {
    EXPECT_GT(counts.meet, cases / 10);
    EXPECT_GT(counts.apart, cases / 10);
    EXPECT_GT(counts.measured, cases / 200);
}

/// The parameter is the exponent of the half-thickness, to base 10.
class ThinHulls : public testing::TestWithParam<int> {};

TEST_P(ThinHulls, AreToldApart) {
    Random random(7300 + static_cast<std::uint64_t>(-GetParam()));
    const double h = std::pow(10, GetParam());
    const int cases = many(120);
    Counts counts;
    ConvexWarmStart warm_start;
    for (int i = 0; i < cases; ++i) {
        const Convex a(points_in(random, {1, 1, h})), b(points_in(random, {1, 1, h}));
        Transform world_a, world_b;
        const double reach = random.chance(0.5) ? 1.6 : 0.8;
        const Vec3 off{reach * random.uniform(-1, 1), reach * random.uniform(-1, 1),
                       h * random.uniform(-2, 2)};
        if (i % 4 != 0) {
            const double angle = random.uniform(0, 3.1);
            world_b = Pose{{}, {std::cos(angle), 0, 0, std::sin(angle)}};
            // The tilt is about as large as the thickness.
            world_b = compose(
                Pose{{}, {1, h * random.uniform(-1, 1), h * random.uniform(-1, 1), 0}}, world_b);
        }
        world_b.m[9] = off.x, world_b.m[10] = off.y, world_b.m[11] = off.z;
        if (i % 4 >= 2) {
            const Transform all =
                compose(translation(random.uniform(-1, 1), 2, 3), random.linear_map(i % 4 == 3));
            world_a = all, world_b = compose(all, world_b);
        }
        check_both_ways(a, world_a, b, world_b, warm_start, i % 20 == 0, counts);
        ASSERT_FALSE(HasFatalFailure()) << "case " << i;
    }
    expect_both(counts, cases);
}
INSTANTIATE_TEST_SUITE_P(ThinHulls, ThinHulls,
                         testing::Values(-3, -5, -6, -7, -8, -9, -10, -11, -12, -13));

TEST(ConvexProof, NeedlesAreToldApart) {
    Random random(7320);
    const int cases = many(600);
    Counts counts;
    ConvexWarmStart warm_start;
    for (int i = 0; i < cases; ++i) {
        const auto needle = [&] {
            const double extent = std::pow(10, random.uniform(0, 8));
            return points_in(random, {extent, std::pow(10, random.uniform(-4, 0)),
                                      std::pow(10, random.uniform(-4, 0))});
        };
        const std::vector<Vec3> points_a = needle(), points_b = needle();
        const Convex a(points_a), b(points_b);
        const Transform world_a = random.pose(1);
        // An inner point of each body; the two points nearly coincide.
        const auto inside = [&](const std::vector<Vec3>& points, const Transform& world) {
            const auto pick = [&] {
                return apply(world, points[static_cast<std::size_t>(random.integer(0, 7))]);
            };
            const double s = random.uniform(0, 1), t = random.uniform(0, 1);
            return s * pick() + (1 - s) * (t * pick() + (1 - t) * pick());
        };
        Transform world_b = i % 2 == 0 ? Transform(random.pose(0)) : world_a;
        world_b.m[9] = world_b.m[10] = world_b.m[11] = 0;
        const Vec3 off = inside(points_a, world_a) - inside(points_b, world_b) +
                         std::pow(10, random.uniform(-5, 0)) * random.direction();
        world_b.m[9] = off.x, world_b.m[10] = off.y, world_b.m[11] = off.z;
        check_both_ways(a, world_a, b, world_b, warm_start, i % 20 == 0, counts);
        ASSERT_FALSE(HasFatalFailure()) << "case " << i;
    }
    expect_both(counts, cases);
}

/// Bodies with small multiples of 1/8 as coordinates. They are moved so that a vertex, an edge or a
/// face of one exactly meets the other, or by a few units in the last place beside that.
TEST(ConvexProof, BodiesThatTouchAreToldApart) {
    Random random(7330);
    const int cases = many(1200);
    Counts counts;
    ConvexWarmStart warm_start;
    for (int i = 0; i < cases; ++i) {
        const auto lattice = [&] {
            std::vector<Vec3> points;
            points.reserve(8);
            for (int k = 0; k < 8; ++k)
                points.push_back(Vec3{1, 1, 1} + 0.125 * random.on_lattice(i % 2 == 0 ? 4 : 8));
            return points;
        };
        const Convex a(lattice()), b(lattice());
        const auto some = [&](const Convex& c) {
            const auto pick = [&] {
                return c.vertices()[static_cast<std::size_t>(random.integer(0, 1'000'000)) %
                                    c.vertices().size()];
            };
            const Vec3 p = pick();
            return i % 3 == 0 ? p : 0.5 * (p + pick()); // also in edges and faces
        };
        Transform world_b;
        if (i % 4 == 1) // turned by a right angle
            world_b = Transform({0, 1, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0});
        else if (i % 4 == 2) // turned inside out
            world_b = Transform({-1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0});
        Vec3 off = some(a) - apply(world_b, some(b));
        if (i % 3 != 1) // a bit aside
            off = off + 0x1p-52 * (random.on_lattice(4) - Vec3{2, 2, 2});
        world_b.m[9] = off.x, world_b.m[10] = off.y, world_b.m[11] = off.z;
        check_both_ways(a, {}, b, world_b, warm_start, i % 9 == 0, counts);
        ASSERT_FALSE(HasFatalFailure()) << "case " << i;
    }
    expect_both(counts, cases);
    EXPECT_GT(counts.touch, cases / 20);
}

/// Curved bodies moved out of each other by their depth but for a little: shallow overlaps are found,
/// and just apart is told.
TEST(ConvexProof, ShallowOverlapsAreFound) {
    Random random(7340);
    const int cases = many(300);
    int shallow = 0, apart = 0;
    ConvexWarmStart warm_start;
    for (int i = 0; i < cases; ++i) {
        const auto curved = [&](int count) {
            std::vector<Vec3> points;
            for (int k = 0; k < count; ++k) {
                const Vec3 d = random.direction();
                points.push_back({d.x, 0.7 * d.y, 0.5 * d.z});
            }
            return points;
        };
        const Convex a(curved(random.integer(20, 400))), b(curved(random.integer(20, 400)));
        const Transform world_a = random.pose(0);
        Transform world_b = random.pose(0.3);
        const ConvexDepth deep = penetration(a, world_a, b, world_b);
        ASSERT_TRUE(deep.meet);
        const double left = std::pow(10, random.uniform(-8, -2)) * (i % 4 == 0 ? -1 : 1);
        const double by = deep.depth - left;
        world_b.m[9] += by * deep.direction.x, world_b.m[10] += by * deep.direction.y;
        world_b.m[11] += by * deep.direction.z;
        const bool meets = left > 0;
        for (ConvexWarmStart* w : {static_cast<ConvexWarmStart*>(nullptr), &warm_start}) {
            const ConvexGap gap = distance(a, world_a, b, world_b, {.warm_start = w});
            const ConvexDepth depth = penetration(a, world_a, b, world_b, {.warm_start = w});
            ASSERT_EQ(gap.distance == 0, meets) << i << ' ' << left << ' ' << gap.distance;
            ASSERT_EQ(depth.meet, meets) << i << ' ' << left;
            ASSERT_EQ(gap.status, Status::exact);
            ASSERT_EQ(depth.status, Status::exact);
            if (!meets) {
                ASSERT_NEAR(gap.distance, -left, 1e-14);
                ASSERT_LE(gap.at_least, gap.distance);
                ASSERT_GE(gap.at_least, gap.distance * (1 - 1e-12) - 1e-13);
                continue;
            }
            ASSERT_LE(depth.depth, left + 1e-14);
            ASSERT_LE(depth.at_least, depth.depth);
            ASSERT_GE(depth.at_least, depth.depth - 1e-13);
        }
        const bool surfaces = collide(Model(a.mesh()), world_a, Model(b.mesh()), world_b).meet();
        ASSERT_EQ(surfaces, meets);
        ++(meets ? shallow : apart);
    }
    EXPECT_GT(shallow, cases / 2);
    EXPECT_GT(apart, cases / 8);
}

/// Curved bodies that slide on each other at a gap, however short: proven by the features that the
/// last step ended with, without a search that begins anew.
TEST(ConvexProof, BodiesThatSlideAreMeasured) {
    Random random(7350);
    const int paths = many(20), steps = 20;
    std::uint32_t pairs = 0, simplices = 0, walked = 0;
    int measured = 0;
    for (int path = 0; path < paths; ++path) {
        const bool small = path % 2 == 0;
        const auto curved = [&] {
            std::vector<Vec3> points;
            for (int k = small ? random.integer(8, 16) : 300; k > 0; --k) {
                const Vec3 d = random.direction();
                points.push_back({d.x, 0.7 * d.y, 0.5 * d.z});
            }
            return Convex(points);
        };
        const Convex a = curved(), b = curved();
        const Transform world_a = random.pose(1);
        const double left = std::pow(10, random.uniform(-12, -2));
        const Vec3 axis = random.direction(), shift = 3 * random.direction();
        ConvexWarmStart warm_start;
        for (int step = 0; step < steps; ++step) {
            const double half = 0.5 * std::numbers::pi / 360 * step;
            const Vec3 q = std::sin(half) * axis;
            Transform world_b =
                Pose{{world_a.m[9] + shift.x, world_a.m[10] + shift.y, world_a.m[11] + shift.z},
                     {std::cos(half), q.x, q.y, q.z}};
            for (const double to : {0.2, left}) {
                const ConvexGap far = distance(a, world_a, b, world_b);
                const Vec3 by = (1 - to / far.distance) * (far.point_a - far.point_b);
                world_b.m[9] += by.x, world_b.m[10] += by.y, world_b.m[11] += by.z;
            }
            const ConvexGap cold = distance(a, world_a, b, world_b);
            const ConvexGap gap = distance(a, world_a, b, world_b, {.warm_start = &warm_start});
            ASSERT_NEAR(gap.distance, left, 1e-14);
            ASSERT_NEAR(cold.distance, gap.distance, 1e-14);
            ASSERT_EQ(gap.status, Status::exact);
            ASSERT_LE(gap.at_least, gap.distance);
            ASSERT_GE(gap.at_least, gap.distance * (1 - 1e-12) - 1e-13);
            if (step > 0 && !small) {
                pairs += gap.counters.feature_pairs, simplices += gap.counters.simplices;
                ++walked;
            }
            if (!small || step != 10)
                continue;
            const Precise truth =
                precise_distance_of_hulls(placed_inputs(a, world_a), placed_inputs(b, world_b));
            ASSERT_LE(gap.at_least, truth);
            ASSERT_LE(cold.at_least, truth);
            ASSERT_LE(abs(truth - gap.distance), 1e-12 * gap.distance + 1e-14);
            ++measured;
        }
    }
    EXPECT_EQ(measured, paths / 2);
    EXPECT_LT(pairs, 3 * walked);
    EXPECT_LT(simplices, walked / 5);
}

} // namespace
} // namespace abut::test
