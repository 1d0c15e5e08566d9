// Options of distance queries: allowed errors, an upper bound, a warm start, features of the
// witness points, a sign.

#include <abut/error.h>
#include <abut/penetration.h>
#include <abut/rigid.h>

#include "geometry/triangle_triangle_distance.h"
#include "scenes/bodies.h"
#include "tests/support/infinity.h"
#include "tests/support/oracle/brute_force.h"
#include "tests/support/oracle/thickness_oracle.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace abut::test {
namespace {

constexpr double kRounding = 64 * 0x1p-53;

/// Two placed models; the second moves around the first.
struct Scene {
    Model a, b;
    Transform world_a, world_b;

    [[nodiscard]] Gap gap(const DistanceOptions& options = {}) const {
        return distance(a, world_a, b, world_b, options);
    }
    [[nodiscard]] bool meet() const { return collide(a, world_a, b, world_b).meet(); }
    [[nodiscard]] Triangle triangle_a(std::uint32_t i) const { return corners(a, world_a, i); }
    [[nodiscard]] Triangle triangle_b(std::uint32_t i) const { return corners(b, world_b, i); }

private:
    static Triangle corners(const Model& model, const Transform& world, std::uint32_t i) {
        const auto& t = model.mesh().triangles.at(i);
        const auto& p = model.mesh().positions;
        return {apply(world, p[t[0]]), apply(world, p[t[1]]), apply(world, p[t[2]])};
    }
};

Mesh any_mesh(Random& random, int kind) {
    switch (kind % 4) {
    case 0:
        return scenes::boulder(500, 7);
    case 1:
        return scenes::knot(600);
    case 2:
        return soup_mesh(random, 150, 0.5, 0.1);
    default:
        return with_degenerates(random, box_mesh({-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3}), 10);
    }
}

/// A random scene, with models up to about 2 apart or meeting.
Scene any_scene(Random& random, int round, double reach) {
    const ModelOptions options{round % 5 == 4 ? Volume::obb : Volume::automatic};
    Scene s{Model(any_mesh(random, round), options),
            Model(any_mesh(random, round / 4), options),
            random.pose(2),
            {}};
    s.world_b = random.pose(0);
    const Vec3 at = apply(s.world_a, {}) + random.uniform(0.2, reach) * random.direction();
    s.world_b.m[9] = at.x, s.world_b.m[10] = at.y, s.world_b.m[11] = at.z;
    return s;
}

TEST(DistanceOptions, WithinTheErrorsAllowed) {
    Random random(4200);
    const std::array<std::array<double, 2>, 9> errors{{{1e-6, 0},
                                                       {0.02, 0},
                                                       {0.5, 0},
                                                       {1e6, 0},
                                                       {0, 1e-6},
                                                       {0, 0.1},
                                                       {0, 0.7},
                                                       {0, 5},
                                                       {0.01, 0.05}}};
    int meet = 0, rounds = 0, inexact = 0;
    std::array<std::uint64_t, errors.size()> tests{};
    std::uint64_t exact_tests = 0;
    for (; rounds < 64; ++rounds) {
        const Scene s = any_scene(random, rounds, 2.2);
        const Gap exact = s.gap();
        meet += exact.distance == 0 ? 1 : 0;
        exact_tests += exact.distance > 0 ? exact.counters.volume_tests : 0;
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const auto [absolute, relative] = errors[i];
            SCOPED_TRACE(testing::Message()
                         << "round " << rounds << " errors " << absolute << ' ' << relative);
            const Gap gap = s.gap({.absolute_error = absolute, .relative_error = relative});
            // A contact is never reported as a gap, nor a gap as a contact.
            ASSERT_EQ(gap.distance == 0, exact.distance == 0);
            ASSERT_EQ(gap.status, exact.distance == 0 ? Status::exact : Status::converged);
            ASSERT_GE(gap.distance, exact.distance - kRounding);
            ASSERT_LE(gap.distance - exact.distance,
                      std::max(absolute, relative * gap.distance) + kRounding);
            ASSERT_LE(gap.at_least, exact.distance + kRounding);
            ASSERT_GE(gap.at_least, 0);
            ASSERT_GE(gap.at_least,
                      gap.distance - std::max(absolute, relative * gap.distance) - 64 * kRounding);
            ASSERT_NEAR(length(gap.point_a - gap.point_b), gap.distance, 1e-14);
            inexact += gap.distance > exact.distance + kRounding ? 1 : 0;
            tests[i] += exact.distance > 0 ? gap.counters.volume_tests : 0;
            if (exact.distance == 0)
                continue;
            const Gap cut = s.gap({.upper_bound = exact.distance / 2,
                                   .absolute_error = absolute,
                                   .relative_error = relative});
            ASSERT_EQ(cut.status, Status::bound_only);
            ASSERT_EQ(cut.distance, exact.distance / 2);
            ASSERT_LE(cut.at_least, exact.distance / 2);
            ASSERT_GE(cut.at_least, exact.distance / 2 - 64 * kRounding);
        }
    }
    std::cout << meet << " of " << rounds << " meet, " << inexact << " inexact; tests "
              << exact_tests << ", with errors " << tests[2] << ' ' << tests[6] << '\n';
    EXPECT_GT(meet, rounds / 6);
    EXPECT_LT(meet, rounds * 2 / 3);
    EXPECT_GT(inexact, 20);
    EXPECT_LT(tests[2], exact_tests * 9 / 10); // an allowed error saves work
    EXPECT_LT(tests[6], exact_tests * 9 / 10);
    EXPECT_LE(tests[0], exact_tests);
}

TEST(DistanceOptions, NoErrorAllowedIsExact) {
    Random random(4201);
    for (int round = 0; round < 20; ++round) {
        const Gap gap = any_scene(random, round, 2.2).gap();
        EXPECT_EQ(gap.status, Status::exact);
        EXPECT_LE(gap.at_least, gap.distance);
        EXPECT_GE(gap.at_least, gap.distance - 64 * kRounding);
    }
}

/// Whether two points of the surfaces are at most `distance` apart, in exact arithmetic. Tests all
/// pairs of features of triangles that are not much farther apart.
bool exactly_within(const Scene& s, double distance) {
    const auto a = placed_triangles(s.a.mesh(), s.world_a),
               b = placed_triangles(s.b.mesh(), s.world_b);
    const auto near = [&](ElementaryKind kind, const std::array<Vec3, 4>& points) {
        return ThicknessOracle({kind, points, points}).within(distance, 0);
    };
    for (const PlacedTriangle& t : a)
        for (const PlacedTriangle& u : b) {
            const Triangle &p = t.corners, &q = u.corners;
            const auto is_farther = [&](double sq) {
                return std::sqrt(sq) * (1 - 1e-9) > distance;
            };
            if (is_farther(box_distance_sq(t.box, u.box)) ||
                is_farther(triangle_triangle_distance(p, q).distance_sq))
                continue;
            for (std::size_t i = 0; i < 3; ++i) {
                if (near(ElementaryKind::vertex_face, {p[i], q[0], q[1], q[2]}) ||
                    near(ElementaryKind::vertex_face, {q[i], p[0], p[1], p[2]}))
                    return true;
                for (std::size_t k = 0; k < 3; ++k)
                    if (near(ElementaryKind::edge_edge,
                             {p[i], p[(i + 1) % 3], q[k], q[(k + 1) % 3]}))
                        return true;
            }
        }
    return false;
}

TEST(DistanceOptions, AtLeastIsNeverAboveTheTrueDistance) {
    Random random(4207);
    int apart = 0, above = 0;
    for (int round = 0; round < many(250); ++round) {
        Scene s = any_scene(random, round, 2.2);
        if (round % 3 == 0) // very different sizes make rounding matter
            s.a = Model(transformed(s.a.mesh(), scaling(1, 1, random.chance(0.5) ? 1e-9 : 1e6)));
        const Gap gap = s.gap();
        if (gap.distance == 0)
            continue;
        ++apart;
        above += exactly_within(s, std::nextafter(gap.distance, 0)) ? 1 : 0;
        ASSERT_LE(gap.at_least, gap.distance);
        // The error is symmetric: the true distance is above the reported one by at most as much as
        // it may be below it.
        ASSERT_TRUE(exactly_within(s, 2 * gap.distance - gap.at_least)) << round;
        for (const DistanceOptions& options :
             {DistanceOptions{}, DistanceOptions{.relative_error = 0.1},
              DistanceOptions{.upper_bound = gap.distance},
              DistanceOptions{.signed_distance = true}}) {
            const Gap bounded = s.gap(options);
            if (bounded.distance > 0) {
                ASSERT_FALSE(exactly_within(s, std::nextafter(bounded.at_least, 0))) << round;
            }
        }
    }
    std::cout << apart << " apart, " << above << " distances above the true one\n";
    EXPECT_GT(apart, many(250) / 4);
    EXPECT_GT(above, many(250) / 125); // rounding matters in some cases
}

TEST(DistanceOptions, NothingIsReturnedAboveTheBound) {
    Random random(4208);
    int apart = 0, beyond = 0;
    for (int round = 0; round < many(300); ++round) {
        const Scene s = any_scene(random, round, 2.2);
        const Gap exact = s.gap();
        if (exact.distance == 0)
            continue;
        ++apart;
        double bound = exact.distance;
        for (int ulps = -3; ulps <= 3; ++ulps) {
            bound = exact.distance * (1 + ulps * 0x1p-52);
            const Gap gap = s.gap({.upper_bound = bound});
            ASSERT_EQ(gap.status == Status::bound_only, !(gap.distance < bound));
            ASSERT_LE(gap.distance, bound);
            ASSERT_LE(gap.at_least, gap.distance);
            if (gap.status == Status::exact) {
                ASSERT_EQ(gap.distance, exact.distance);
            }
            beyond += gap.status == Status::bound_only ? 1 : 0;
        }
    }
    std::cout << apart << " apart, " << beyond << " beyond their bounds\n";
    EXPECT_GT(apart, many(300) / 4);
    EXPECT_GT(beyond, 3 * apart);
    EXPECT_LT(beyond, 6 * apart);
}

/// Places the second model on a path around the first, in and out of it; with `jump`, anywhere.
Transform on_path(Random& random, const Scene& s, int step, bool jump) {
    if (jump) {
        Transform t = random.pose(0);
        const Vec3 at = apply(s.world_a, {}) + random.uniform(0.3, 2) * random.direction();
        t.m[9] = at.x, t.m[10] = at.y, t.m[11] = at.z;
        return t;
    }
    const double angle = 0.02 * step, away = 1.15 + 0.35 * std::sin(3 * angle);
    const Vec3 at = apply(s.world_a, {away * std::cos(angle), away * std::sin(angle), 0.1});
    return Transform(Pose{at, {std::cos(angle), 0.3 * std::sin(angle), 0, std::sin(angle)}});
}

TEST(DistanceOptions, AWarmStartChangesNoAnswer) {
    Random random(4202);
    for (const bool jump : {false, true}) {
        std::uint64_t tests = 0, tests_with = 0, first_tests = 0, first_tests_with = 0;
        int meet = 0, steps = 0;
        for (int kinds = 0; kinds < 4; ++kinds) {
            Scene s = any_scene(random, 5 * kinds % 16, 1);
            WarmStart of_distance, of_collide, of_within;
            for (int step = 0; step < 100; ++step, ++steps) {
                s.world_b = on_path(random, s, step, jump);
                const Gap plain = s.gap(), with = s.gap({.warm_start = &of_distance});
                ASSERT_NEAR(with.distance, plain.distance, kRounding);
                ASSERT_EQ(with.distance == 0, plain.distance == 0);
                ASSERT_EQ(with.status, plain.status);
                ASSERT_NEAR(length(with.point_a - with.point_b), with.distance, 1e-14);
                ASSERT_TRUE(of_distance.used);
                ASSERT_EQ(of_distance.last, (TrianglePair{with.triangle_a, with.triangle_b}));
                tests += plain.counters.volume_tests, tests_with += with.counters.volume_tests;

                const Contacts first = collide(s.a, s.world_a, s.b, s.world_b),
                               first_with = collide(s.a, s.world_a, s.b, s.world_b,
                                                    {.warm_start = &of_collide});
                ASSERT_EQ(first.meet(), first_with.meet());
                ASSERT_EQ(first.meet(), plain.distance == 0);
                if (first_with.meet()) {
                    const TrianglePair& pair = first_with.pairs.at(0);
                    ASSERT_EQ(triangle_triangle_distance(s.triangle_a(pair.a), s.triangle_b(pair.b))
                                      .distance_sq < 1e-25,
                              true);
                    first_tests += first.counters.volume_tests;
                    first_tests_with += first_with.counters.volume_tests;
                    ++meet;
                }
                for (const double tolerance :
                     {0.0, 0.1, plain.distance + kRounding, plain.distance / 2}) {
                    ASSERT_EQ(within(s.a, s.world_a, s.b, s.world_b, tolerance,
                                     {.warm_start = &of_within}),
                              within(s.a, s.world_a, s.b, s.world_b, tolerance))
                        << tolerance << ' ' << plain.distance;
                }
            }
        }
        std::cout << (jump ? "jumps: " : "path: ") << meet << " of " << steps
                  << " meet; volume tests " << tests << ", with a warm start " << tests_with
                  << "; first contact " << first_tests << ", " << first_tests_with << '\n';
        EXPECT_GT(meet, steps / 10);
        EXPECT_LT(meet, steps * 9 / 10);
        if (!jump) {
            EXPECT_LT(tests_with, tests * 9 / 10);
            EXPECT_LT(first_tests_with, first_tests * 3 / 4);
        }
    }
}

TEST(DistanceOptions, AWarmStartOfOtherModelsDoesNoHarm) {
    Random random(4203);
    const std::array<TrianglePair, 6> strange{
        {{0, 0}, {~0U, ~0U}, {11, 1000000}, {1000000, 3}, {0x80000000U, 0x7fffffffU}, {499, 499}}};
    WarmStart travelling; // one warm start for all pairs of models
    int meet = 0;
    for (int round = 0; round < 32; ++round) {
        const Scene s = any_scene(random, round, 2);
        const Gap plain = s.gap();
        meet += plain.distance == 0 ? 1 : 0;
        ASSERT_NEAR(s.gap({.warm_start = &travelling}).distance, plain.distance, kRounding);
        for (const TrianglePair& last : strange)
            for (const bool used : {false, true}) {
                WarmStart w{used, last};
                ASSERT_NEAR(s.gap({.warm_start = &w}).distance, plain.distance, kRounding);
                w = {used, last};
                ASSERT_NEAR(s.gap({.upper_bound = plain.distance / 2, .warm_start = &w}).distance,
                            plain.distance / 2, kRounding);
                w = {used, last};
                ASSERT_EQ(collide(s.a, s.world_a, s.b, s.world_b, {.warm_start = &w}).meet(),
                          plain.distance == 0);
                w = {used, last};
                ASSERT_EQ(within(s.a, s.world_a, s.b, s.world_b, 0.2, {.warm_start = &w}),
                          plain.distance <= 0.2);
            }
    }
    EXPECT_GT(meet, 4);
    EXPECT_LT(meet, 28);
    const Model none(Mesh{}), box(box_mesh({0, 0, 0}, {1, 1, 1}));
    WarmStart w{true, {0, 0}};
    EXPECT_EQ(distance(none, {}, box, {}, {.warm_start = &w}).distance, kInfinity);
    EXPECT_FALSE(collide(box, {}, none, {}, {.warm_start = &w}).meet());
    EXPECT_FALSE(within(none, {}, none, {}, 1, {.warm_start = &w}));
}

TEST(DistanceOptions, ARememberedContactHasItsSegment) {
    const Model box(box_mesh({0, 0, 0}, {1, 1, 1}));
    WarmStart w;
    const CollideOptions options{.warm_start = &w, .segments = true};
    const Contacts first = collide(box, {}, box, translation(0.5, 0.4, 0.3), options),
                   again = collide(box, {}, box, translation(0.5, 0.4, 0.3), options);
    EXPECT_EQ(again.counters.volume_tests, 0U);
    EXPECT_EQ(again.pairs, first.pairs);
    ASSERT_EQ(first.segments.size(), 1U);
    ASSERT_EQ(again.segments.size(), 1U);
    EXPECT_EQ(again.segments[0].count, first.segments[0].count);
    EXPECT_EQ(again.segments[0].corners, first.segments[0].corners);
}

/// Distance of a point from the feature that it is said to lie on.
double off_feature(const Vec3& p, const Triangle& t, Feature feature, std::uint8_t index) {
    switch (feature) {
    case Feature::vertex:
        return length(p - t[index]);
    case Feature::edge:
        return std::sqrt(segment_segment_distance(p, p, t[index], t[(index + 1) % 3]).distance_sq);
    default:
        return std::sqrt(point_triangle_distance(p, t).distance_sq);
    }
}

TEST(DistanceOptions, WitnessPointsLieOnTheNamedFeatures) {
    Random random(4204);
    std::array<std::array<int, 3>, 3> count{}; // counts by feature of a and feature of b
    for (int round = 0; round < 200; ++round) {
        const Scene s = any_scene(random, round, 2);
        const Gap gap = s.gap();
        SCOPED_TRACE(testing::Message() << "round " << round << " distance " << gap.distance);
        ASSERT_LT(gap.index_a, 3);
        ASSERT_LT(gap.index_b, 3);
        const Triangle a = s.triangle_a(gap.triangle_a), b = s.triangle_b(gap.triangle_b);
        const double off_a = off_feature(gap.point_a, a, gap.feature_a, gap.index_a),
                     off_b = off_feature(gap.point_b, b, gap.feature_b, gap.index_b);
        ASSERT_LE(off_a, gap.feature_a == Feature::vertex ? 0 : 1e-14);
        ASSERT_LE(off_b, gap.feature_b == Feature::vertex ? 0 : 1e-14);
        // The lowest feature is reported: an end of an edge is a vertex.
        if (gap.distance > 0) {
            for (const Vec3& p : a)
                ASSERT_TRUE(gap.feature_a == Feature::vertex || !(gap.point_a == p));
            for (const Vec3& p : b)
                ASSERT_TRUE(gap.feature_b == Feature::vertex || !(gap.point_b == p));
            ++count[std::size_t(gap.feature_a)][std::size_t(gap.feature_b)];
        }
        const Gap swapped = distance(s.b, s.world_b, s.a, s.world_a);
        ASSERT_NEAR(swapped.distance, gap.distance, kRounding);
    }
    const auto vertex = std::size_t(Feature::vertex), edge = std::size_t(Feature::edge),
               face = std::size_t(Feature::face);
    EXPECT_GT(count[vertex][vertex], 0);
    EXPECT_GT(count[vertex][face], 0);
    EXPECT_GT(count[face][vertex], 0);
    EXPECT_GT(count[edge][edge], 5);
    EXPECT_EQ(count[face][face], 0); // a vertex or an edge is always as near
    EXPECT_EQ(count[edge][face], 0);
    EXPECT_EQ(count[face][edge], 0);
}

TEST(DistanceOptions, FeaturesByHand) {
    const Model point(Mesh{{{0, 0, 0}}, {{0, 0, 0}}}),
        triangle(Mesh{{{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}}, {{0, 1, 2}}});
    const auto at = [&](double x, double y, double z) {
        return distance(point, translation(x, y, z), triangle, {});
    };
    Gap gap = at(0, 0, 2);
    EXPECT_EQ(gap.feature_a, Feature::vertex);
    EXPECT_EQ(gap.feature_b, Feature::face);
    EXPECT_EQ(gap.distance, 2);
    gap = at(0.5, -2, 0);
    EXPECT_EQ(gap.feature_b, Feature::edge);
    EXPECT_EQ(gap.index_b, 0);
    gap = at(2, 2, 1);
    EXPECT_EQ(gap.feature_b, Feature::edge);
    EXPECT_EQ(gap.index_b, 1);
    gap = at(-2, 0.5, 1);
    EXPECT_EQ(gap.feature_b, Feature::edge);
    EXPECT_EQ(gap.index_b, 2);
    for (const auto& [x, y, vertex] : {std::array{-2.0, -2.0, 0.0}, {5.0, -1.0, 1.0}, {-1, 5, 2}}) {
        gap = at(x, y, 0);
        EXPECT_EQ(gap.feature_b, Feature::vertex);
        EXPECT_EQ(gap.index_b, int(vertex));
    }
}

TEST(DistanceOptions, SignedDistanceApartAndInside) {
    Random random(4205);
    int inside = 0, apart = 0, across = 0;
    for (int round = 0; round < 40; ++round) {
        const Mesh mesh_a = round % 2 == 0 ? scenes::boulder(300, 7) : scenes::knot(300),
                   mesh_b = scenes::boulder(100, 5);
        const double size = round % 4 < 2 ? 1 : 0.05;
        Scene s{Model(mesh_a),
                Model(transformed(mesh_b, scaling(size, size, size))),
                random.pose(1),
                {}};
        s.world_b = random.pose(0);
        const Vec3 at =
            apply(s.world_a, {}) + random.uniform(0, size < 1 ? 0.6 : 1.3) * random.direction();
        s.world_b.m[9] = at.x, s.world_b.m[10] = at.y, s.world_b.m[11] = at.z;
        const Gap plain = s.gap(), gap = s.gap({.signed_distance = true});
        const Depth depth = penetration(s.a, s.world_a, s.b, s.world_b, {.separation = false});
        if (!depth.interpenetrate && plain.distance > 0) {
            ASSERT_NEAR(gap.distance, plain.distance, kRounding);
            ASSERT_EQ(gap.status, Status::exact);
            const Gap near = s.gap({.upper_bound = plain.distance / 2, .signed_distance = true});
            ASSERT_EQ(near.status, Status::bound_only);
            ASSERT_EQ(near.distance, plain.distance / 2);
            const Gap coarse = s.gap({.relative_error = 0.5, .signed_distance = true});
            ASSERT_EQ(coarse.status, Status::converged);
            ASSERT_LE(coarse.at_least, plain.distance + kRounding);
            ++apart;
            continue;
        }
        (plain.distance > 0 ? inside : across) += 1;
        ASSERT_LT(gap.distance, 0);
        ASSERT_LE(gap.at_least, gap.distance);
        ASSERT_NEAR(length(gap.point_a - gap.point_b), -gap.distance, 1e-13);
        // The two queries' bounds of the depth agree.
        ASSERT_LE(-gap.distance, depth.depth_at_most + 1e-13);
        ASSERT_LE(depth.depth, -gap.at_least + 1e-13);
        if (plain.distance > 0) {
            ASSERT_GE(-gap.distance, plain.distance * (1 - 0.02)); // no surface point is nearer
        }
    }
    std::cout << inside << " inside, " << across << " across, " << apart << " apart\n";
    EXPECT_GT(inside, 1);
    EXPECT_GT(across, 5);
    EXPECT_GT(apart, 5);
}

TEST(DistanceOptions, SignedDistanceOfModelsWithoutAnInside) {
    const Model none(Mesh{}), box(box_mesh({0, 0, 0}, {1, 1, 1})),
        sheet(Mesh{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}}, {{0, 1, 2}}});
    const DistanceOptions options{.signed_distance = true};
    EXPECT_EQ(distance(none, {}, box, {}, options).distance, kInfinity);
    EXPECT_EQ(distance(none, {}, box, {}, options).status, Status::bound_only);
    EXPECT_EQ(distance(box, {}, none, {}, {.upper_bound = 2, .signed_distance = true}).distance, 2);
    EXPECT_EQ(distance(sheet, {}, sheet, translation(0, 0, 1), options).distance, 1);
    // No point is inside the other box, yet the boxes coincide and are a unit deep.
    EXPECT_NEAR(distance(box, {}, box, {}, options).distance, -1, 1e-6);
    EXPECT_EQ(distance(box, {}, box, translation(1, 0, 0), options).distance, 0);
    EXPECT_EQ(distance(box, scaling(1, 1, 0), box, translation(0, 0, 2), options).distance, 2);
}

TEST(DistanceOptions, AnUpperBoundOfZeroAsksForContactAlone) {
    Random random(4206);
    int meet = 0;
    for (int round = 0; round < 32; ++round) {
        const Scene s = any_scene(random, round, 2);
        const Gap gap = s.gap({.upper_bound = 0});
        EXPECT_EQ(gap.distance, 0);
        EXPECT_EQ(gap.status, s.meet() ? Status::exact : Status::bound_only);
        meet += s.meet() ? 1 : 0;
    }
    EXPECT_GT(meet, 4);
    EXPECT_LT(meet, 28);
}

TEST(DistanceOptions, BadOptionsAreErrors) {
    const Model box(box_mesh({0, 0, 0}, {1, 1, 1}));
    const auto code = [&](const DistanceOptions& options) {
        try {
            (void)distance(box, {}, box, translation(2, 0, 0), options);
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()), "");
            return error.code();
        }
        ADD_FAILURE() << "no error";
        return ErrorCode::interrupted;
    };
    for (const bool sign : {false, true})
        for (const double bad : {-1.0, -kInfinity, -1e-300, std::nan("")}) {
            EXPECT_EQ(code({.upper_bound = bad, .signed_distance = sign}), ErrorCode::bad_argument);
            EXPECT_EQ(code({.absolute_error = bad, .signed_distance = sign}),
                      ErrorCode::bad_argument);
            EXPECT_EQ(code({.relative_error = bad, .signed_distance = sign}),
                      ErrorCode::bad_argument);
        }
    // Any error is allowed, but the models are still apart.
    const Gap any = distance(box, {}, box, translation(2, 0, 0),
                             {.absolute_error = kInfinity, .relative_error = kInfinity});
    EXPECT_GE(any.distance, 1);
    EXPECT_EQ(any.at_least, 0);
    EXPECT_EQ(any.status, Status::converged);
}

} // namespace
} // namespace abut::test
