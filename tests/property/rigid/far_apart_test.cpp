// Distances of surfaces that are nearly parallel and far apart, and of triangles that coincide: many
// pairs are equally near, and single precision tells hardly any of them apart. The work is counted.

#include <abut/rigid.h>
#include <abut/shape_queries.h>

#include "geometry/leaf/triangle_pair_batch.h"
#include "geometry/point_triangle_distance.h"
#include "geometry/triangle_triangle_distance.h"
#include "rigid/model/placed_model.h"
#include "rigid/pair/placed_pair.h"
#include "scenes/bodies.h"
#include "tests/support/oracle/brute_force.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace abut::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A plate from -1 to 1 whose height is a function of its place.
Mesh plate(int cells, auto&& height) {
    return grid_mesh(cells, cells, false, false, [&](double u, double v) {
        const double x = 2 * u - 1, y = 2 * v - 1;
        return Vec3{x, y, height(x, y)};
    });
}
Mesh flat_plate(int cells) {
    return plate(cells, [](double, double) { return 0.0; });
}

std::uint64_t work(const Gap& gap) {
    return gap.counters.volume_tests + gap.counters.primitive_tests;
}
std::size_t triangles(const Model& a, const Model& b) {
    return a.mesh().triangles.size() + b.mesh().triangles.size();
}

TEST(FarApart, PlatesCostTheSameAtAnyDistance) {
    for (const int cells : {8, 32, 64}) {
        const Model a(flat_plate(cells)), b(flat_plate(cells));
        const std::uint64_t near = work(distance(a, {}, b, translation(0, 0, 1)));
        for (const double apart : {3.0, 10.0, 100.0, 1e3, 1e4, 1e6, 1e9}) {
            SCOPED_TRACE(testing::Message() << cells << " cells, " << apart << " apart");
            const Transform up = translation(0, 0, apart);
            const Gap gap = distance(a, {}, b, up);
            EXPECT_EQ(gap.distance, apart);
            EXPECT_EQ(gap.status, Status::exact);
            EXPECT_LE(gap.at_least, apart);
            EXPECT_GE(gap.at_least, apart * (1 - 1e-12));
            EXPECT_LE(work(gap), 2 * near + 256);
            // So does the proof that nothing is nearer than a bound.
            const Gap none = distance(a, {}, b, up, {.upper_bound = apart * (1 - 1e-9)});
            EXPECT_EQ(none.status, Status::bound_only);
            EXPECT_LE(work(none), 2 * near + 256);
            EXPECT_TRUE(within(a, {}, b, up, apart));
            EXPECT_TRUE(within(a, {}, b, up, apart * (1 + 1e-9)));
            EXPECT_FALSE(within(a, {}, b, up, apart * (1 - 1e-9)));
            EXPECT_FALSE(within(a, {}, b, up, std::nextafter(apart, 0)));
        }
        // A test for each triangle, beside those of the first look.
        EXPECT_LE(near, 2048 + triangles(a, b));
    }
}

TEST(FarApart, OfEachKindOfVolume) {
    const Mesh mesh = flat_plate(32);
    for (const Volume volume : {Volume::aabb, Volume::sphere, Volume::kdop14, Volume::kdop26,
                                Volume::obb, Volume::pss, Volume::lss, Volume::rss, Volume::ssv}) {
        const Model model(mesh, {.volume = volume});
        const Gap near = distance(model, {}, model, translation(0.25, 0, 1)),
                  far = distance(model, {}, model, translation(0.25, 0, 1000));
        EXPECT_EQ(near.distance, 1);
        EXPECT_EQ(far.distance, 1000);
        EXPECT_LE(work(far), 4 * work(near) + 1024) << int(volume);
    }
}

/// Two nearly parallel surfaces.
struct Nearly {
    Mesh a, b;
    Transform world_a, world_b;
};

/// Waves, noise, a tilt, a bend, or steps, of an amplitude from 1e-9 to 0.1.
Mesh uneven_plate(Random& random, int cells) {
    const double amplitude = std::pow(10, random.uniform(-9, -1));
    const Vec3 tilt = amplitude * random.in_cube();
    const double bend = random.uniform(-1, 1), wave = random.uniform(1, 9);
    switch (random.integer(0, 4)) {
    case 0:
        return plate(cells, [&](double, double) { return amplitude * random.uniform(-1, 1); });
    case 1:
        return plate(cells, [&](double x, double y) { return tilt.x * x + tilt.y * y; });
    case 2:
        return plate(cells, [&](double x, double y) { return amplitude * bend * (x * x + y * y); });
    case 3:
        return plate(cells, [&](double x, double y) {
            return amplitude * std::sin(wave * x) * std::cos(y);
        });
    default:
        return plate(cells, [&](double, double) { return amplitude * random.integer(0, 1); });
    }
}

Nearly nearly_parallel(Random& random, int cells) {
    Nearly pair{uneven_plate(random, cells), uneven_plate(random, cells), {}, {}};
    const double apart = std::pow(10, random.uniform(0, 6));
    // On a grid and above one another, or anywhere; in the world's axes, or turned; at the origin, or
    // far from it.
    const Vec3 aside = random.chance(0.5) ? Vec3{} : random.in_cube();
    pair.world_b = translation(aside.x, aside.y, apart);
    if (random.chance(0.5)) {
        const Transform world = random.pose(random.chance(0.5) ? 0 : 1e4);
        pair.world_a = world;
        pair.world_b = compose(world, pair.world_b);
    }
    return pair;
}

/// The least distance as the search measures it, and the smallest indices of the pairs that have it.
MeasuredGap brute_gap(const PlacedPair& pair) {
    MeasuredGap best;
    TrianglePair indices;
    const auto count_a = static_cast<std::uint32_t>(pair.a().mesh().triangles.size()),
               count_b = static_cast<std::uint32_t>(pair.b().mesh().triangles.size());
    TrianglePairBatch batch{};
    for (std::uint32_t i = 0; i < count_a; ++i)
        for (std::uint32_t j = 0; j < count_b; j += TrianglePairBatch::kLanes) {
            const auto lanes = std::min<std::uint32_t>(TrianglePairBatch::kLanes, count_b - j);
            for (std::uint32_t lane = 0; lane < TrianglePairBatch::kLanes; ++lane)
                batch.set(lane, pair.triangle_a(i), pair.triangle_b(j + std::min(lane, lanes - 1)));
            double sq[TrianglePairBatch::kLanes];
            distance_sq(batch, sq);
            for (std::uint32_t lane = 0; lane < lanes; ++lane)
                if (sq[lane] < best.measured_sq)
                    best.measured_sq = sq[lane], indices = {i, j + lane};
        }
    best.gap.triangle_a = indices.a, best.gap.triangle_b = indices.b;
    return best;
}

TEST(FarApart, NearlyParallelSurfacesAgainstAllPairs) {
    Random random(3211);
    int ended_early = 0;
    std::uint64_t most = 0;
    const int rounds = many(60);
    for (int round = 0; round < rounds; ++round) {
        SCOPED_TRACE(round);
        const Nearly scene = nearly_parallel(random, 12);
        const Model a(scene.a), b(scene.b);
        const PlacedPair pair(a, scene.world_a, b, scene.world_b);
        const MeasuredGap brute = brute_gap(pair);
        const double least = std::sqrt(brute.measured_sq);
        const Gap gap = distance(a, scene.world_a, b, scene.world_b);
        ASSERT_EQ(gap.status, Status::exact);
        ASSERT_LE(gap.at_least, least);
        ASSERT_GE(gap.distance, least * (1 - 4 * 0x1p-53));
        ASSERT_LE(gap.distance, least + 2 * (gap.distance - gap.at_least));
        ASSERT_LE(gap.distance, least * (1 + 128 * 0x1p-53) + 16 * 0x1p-53);
        ended_early += gap.distance > least * (1 + 4 * 0x1p-53) ? 1 : 0;
        ASSERT_LE(gap.distance - gap.at_least, 1e-13 * (least + 1e4));
        // Of the pairs with the least distance, the one with the smallest indices, to the last bit.
        const MeasuredGap canonical = nearest_gap(pair, kInfinity);
        ASSERT_EQ(canonical.measured_sq, brute.measured_sq);
        ASSERT_EQ(canonical.gap.triangle_a, brute.gap.triangle_a);
        ASSERT_EQ(canonical.gap.triangle_b, brute.gap.triangle_b);
        const double error = 2 * (gap.distance - gap.at_least);
        ASSERT_TRUE(within(a, scene.world_a, b, scene.world_b, least + error));
        ASSERT_FALSE(within(a, scene.world_a, b, scene.world_b, least - error));
        const Gap none =
            distance(a, scene.world_a, b, scene.world_b, {.upper_bound = least - error});
        ASSERT_EQ(none.status, Status::bound_only);
        for (const Gap& each : {gap, none})
            most = std::max<std::uint64_t>(most, work(each) / triangles(a, b));
    }
    std::cout << ended_early << " of " << rounds << " end at another pair, to rounding; at most "
              << most << " tests a triangle\n";
    EXPECT_GT(most, 16U); // some are hard
}

TEST(FarApart, UnevenPlatesAreNotQuadratic) {
    Random random(3212);
    std::uint64_t most = 0, hard = 0;
    const int rounds = many(40);
    for (int round = 0; round < rounds; ++round) {
        SCOPED_TRACE(round);
        const Nearly scene = nearly_parallel(random, 48);
        const Model a(scene.a), b(scene.b);
        const Gap gap = distance(a, scene.world_a, b, scene.world_b);
        ASSERT_EQ(gap.status, Status::exact);
        const std::uint64_t of_triangle = work(gap) / triangles(a, b);
        most = std::max(most, of_triangle);
        hard += of_triangle > 16 ? 1U : 0U;
        // There are 2,304 pairs for each triangle of both surfaces. Some seeds need 273 tests.
        ASSERT_LE(of_triangle, 500U);
        const Gap none = distance(a, scene.world_a, b, scene.world_b,
                                  {.upper_bound = gap.distance * (1 - 1e-7)});
        ASSERT_EQ(none.status, Status::bound_only);
        ASSERT_LE(work(none) / triangles(a, b), 500U);
    }
    std::cout << hard << " of " << rounds << " are hard, at most " << most << " tests a triangle\n";
    EXPECT_GT(hard, 0U);
}

/// So many copies of a mesh in one mesh.
Mesh copies(const Mesh& mesh, int count) {
    Mesh all;
    for (int i = 0; i < count; ++i)
        all = joined(std::move(all), mesh);
    return all;
}

TEST(FarApart, CoincidentTrianglesAreNotQuadratic) {
    Mesh triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    Random random(3213);
    const Mesh ball = sphere_mesh(0.5, 6, 6), knot = scenes::knot(60);
    for (const double apart : {1e-3, 1.0, 1e3}) {
        const Model many_triangles(copies(triangle, 2000)), few_triangles(copies(triangle, 20));
        EXPECT_LE(
            work(distance(many_triangles, {}, many_triangles, translation(0.3, 0.1, apart))),
            4 * work(distance(few_triangles, {}, few_triangles, translation(0.3, 0.1, apart))) +
                256);
        for (const Mesh& mesh : {ball, knot}) {
            const Model one(mesh), all(copies(mesh, 40));
            const Transform a = random.pose(0),
                            b = compose(translation(3 + apart, 0.1, 0.2), random.pose(0));
            const Gap gap = distance(all, a, all, b), reference = distance(one, a, one, b);
            EXPECT_NEAR(gap.distance, reference.distance, 1e-14 * (3 + apart));
            EXPECT_LE(work(gap) / triangles(all, all), 64U) << apart;
        }
    }
}

/// The clash job's search, which wants the smallest indices of all pairs that are equally near.
TEST(FarApart, TheLeastPairOfCopiesIsFoundWithoutAllPairs) {
    Random random(3215);
    Mesh triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    int checked = 0;
    for (const double apart : {1e-3, 1.0, 1e3})
        for (const bool is_turned : {false, true})
            for (const Mesh& mesh :
                 {triangle, sphere_mesh(0.5, 6, 6), box_mesh({0, 0, 0}, {1, 1, 1})}) {
                const Transform a = is_turned ? random.pose(0) : Transform{},
                                b = compose(translation(3 + apart, 0.1, 0.2), a);
                const int few = 8, many_copies = mesh.triangles.size() == 1 ? 4000 : 200;
                const Model small(copies(mesh, few)), large(copies(mesh, many_copies));
                const PlacedPair pair(small, a, small, b), large_pair(large, a, large, b);
                const MeasuredGap brute = brute_gap(pair), found = nearest_gap(pair, kInfinity),
                                  of_all = nearest_gap(large_pair, kInfinity);
                for (const MeasuredGap& each : {found, of_all}) {
                    ASSERT_EQ(each.measured_sq, brute.measured_sq);
                    ASSERT_EQ(each.gap.triangle_a, brute.gap.triangle_a);
                    ASSERT_EQ(each.gap.triangle_b, brute.gap.triangle_b);
                }
                EXPECT_GT(work(of_all.gap), 0U);
                // Some poses need 240 tests. All pairs would be 1,000 and more for each triangle.
                EXPECT_LE(work(of_all.gap) / triangles(large, large), 500U) << apart;
                ++checked;
            }
    EXPECT_EQ(checked, 18);
}

/// Nearest points of a model to a point that is up to 1e9 times as far away as the model is large.
TEST(FarApart, NearestOfAFarPointIsNotLinear) {
    Random random(3216);
    std::uint64_t most = 0;
    const Mesh ball = sphere_mesh(0.5, 96, 96), knot = scenes::knot(400);
    const Mesh rough = plate(96, [&](double, double) { return 0.01 * random.uniform(-1, 1); });
    for (const Mesh& mesh : {ball, knot, rough, flat_plate(96)}) {
        const Model model(mesh);
        for (int i = 0; i < many(60); ++i) {
            SCOPED_TRACE(i);
            const double apart = std::pow(10, random.uniform(1, 9));
            const bool is_along_an_axis = random.chance(0.5);
            const Vec3 way =
                is_along_an_axis ? Vec3{0, 0, random.chance(0.5) ? 1.0 : -1.0} : random.direction();
            const double aside = random.chance(0.5) ? 0 : 0.3;
            const Transform world = random.chance(0.5)   ? Transform{}
                                    : random.chance(0.5) ? Transform(random.pose(1))
                                                         : random.linear_map(true);
            const Vec3 point = apply(world, apart * way + Vec3{aside, 0.1 * aside, 0});
            double brute = kInfinity;
            for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
                brute = std::min(
                    brute,
                    nearest_on_triangle(point, model.data().world_triangle(t, world)).distance_sq);
            const double least = std::sqrt(brute);
            const Nearest found = nearest(model, world, point);
            ASSERT_EQ(found.status, Status::exact);
            ASSERT_NEAR(found.distance, least, 1e-14 * (least + 10));
            const Nearest none =
                nearest(model, world, point, {.upper_bound = least * (1 - 1e-12) - 1e-12});
            ASSERT_EQ(none.status, Status::bound_only);
            const Nearest just =
                nearest(model, world, point, {.upper_bound = least * (1 + 1e-12) + 1e-12});
            ASSERT_EQ(just.status, Status::exact);
            std::uint64_t visits = 0;
            double best = kInfinity;
            PlacedModel(model, world).for_each_near(point, kInfinity, [&](std::uint32_t slot) {
                ++visits;
                return best = std::min(
                           best, nearest_on_triangle(point, model.data().world_slot(slot, world))
                                     .distance_sq);
            });
            most = std::max(most, visits);
            // Boxes that are seen askew overlap in depth by their size, the root of a triangle's share.
            ASSERT_LE(visits * visits, 100 * mesh.triangles.size()) << apart;
        }
    }
    std::cout << "at most " << most << " triangles visited\n";
}

TEST(FarApart, LimitsOfStepsHold) {
    const Nearly scene = [] {
        Random random(3214);
        return Nearly{plate(24, [&](double, double) { return 1e-4 * random.uniform(-1, 1); }),
                      plate(24, [&](double, double) { return 1e-4 * random.uniform(-1, 1); }),
                      {},
                      translation(0, 0, 3000)};
    }();
    const Model a(scene.a), b(scene.b);
    const Gap whole = distance(a, scene.world_a, b, scene.world_b);
    ASSERT_FALSE(whole.out_of_steps);
    int ran_out = 0;
    for (std::uint64_t steps = 0; steps <= whole.steps; steps += 1 + steps / 3) {
        const Gap gap = distance(a, scene.world_a, b, scene.world_b, {.max_steps = steps});
        ASSERT_LE(gap.steps, steps);
        ran_out += gap.out_of_steps ? 1 : 0;
        ASSERT_LE(gap.at_least, whole.distance) << steps;
        ASSERT_GE(gap.distance, whole.at_least);
        ASSERT_EQ(gap.out_of_steps, gap.status == Status::bound_only);
    }
    EXPECT_GT(ran_out, 5);
    EXPECT_EQ(distance(a, scene.world_a, b, scene.world_b, {.max_steps = whole.steps}).distance,
              whole.distance);
}

} // namespace
} // namespace abut::test
