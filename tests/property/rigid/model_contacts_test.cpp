// Contact manifolds of random solids: against brute force, against penetration, from step to step.

#include <abut/model_contacts.h>
#include <abut/penetration.h>
#include <abut/rigid.h>

#include "geometry/point_triangle_distance.h"
#include "math/vector.h"
#include "scenes/bodies.h"
#include "scenes/space.h"
#include "tests/support/rounds.h"
#include "tests/support/solids.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <limits>
#include <thread>
#include <vector>

namespace abut::test {
namespace {

/// The distance of a point from a surface, over all triangles.
double distance_to(const Model& model, const Transform& world, const Vec3& p) {
    double least_sq = std::numeric_limits<double>::infinity();
    for (const auto& t : model.mesh().triangles) {
        const auto& q = model.mesh().positions;
        const Triangle corners{apply(world, q[t[0]]), apply(world, q[t[1]]), apply(world, q[t[2]])};
        least_sq = std::min(least_sq, point_triangle_distance(p, corners).distance_sq);
    }
    return std::sqrt(least_sq);
}

Transform shifted(Transform t, const Vec3& shift) {
    t.m[9] += shift.x, t.m[10] += shift.y, t.m[11] += shift.z;
    return t;
}

/// Two bodies that just overlap along a direction: `depth` deeper than where they part.
struct ShallowPair {
    Model a, b;
    Transform place_a, place_b;
};

/// Moves b along a direction until the surfaces meet, then `depth` further.
ShallowPair shallow_pair(Random& random, Model a, Model b, double depth) {
    ShallowPair pair{std::move(a), std::move(b), random.pose(0), random.pose(0)};
    const Vec3 way = random.direction();
    double far = 10, near = 0;
    const Transform start = pair.place_b;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (near + far);
        const bool meet =
            collide(pair.a, pair.place_a, pair.b, shifted(start, middle * way)).meet();
        (meet ? near : far) = middle;
    }
    pair.place_b = shifted(start, (far - depth) * way);
    return pair;
}

void expect_on_surfaces(const ShallowPair& pair, const ModelManifold& m) {
    ASSERT_GE(m.count, 1U);
    ASSERT_LE(m.count, 4U);
    EXPECT_NEAR(length(m.normal), 1, 1e-12);
    for (std::uint32_t i = 0; i < m.count; ++i) {
        const ContactPoint& p = m.points[i];
        EXPECT_LE(distance_to(pair.a, pair.place_a, p.point_a), 1e-9);
        EXPECT_LE(distance_to(pair.b, pair.place_b, p.point_b), 1e-9);
        EXPECT_NEAR(dot(m.normal, p.point_a - p.point_b), p.depth, 1e-9);
    }
}

double deepest(const std::vector<ModelManifold>& manifolds) {
    double depth = 0;
    for (const ModelManifold& m : manifolds)
        for (std::uint32_t i = 0; i < m.count; ++i)
            depth = std::max(depth, m.points[i].depth);
    return depth;
}

TEST(ModelContactsProperty, PointsLieOnTheSurfaces) {
    Random random(20261124);
    int met = 0, deep = 0;
    const int cases = many(120);
    for (int i = 0; i < cases; ++i) {
        const int kind_a = random.integer(0, kSolidKinds - 1), kind_b = random.integer(0, 9);
        const double sunk = random.chance(0.5) ? 0.02 : 0.4, margin = random.chance(0.3) ? 0.05 : 0;
        const ShallowPair pair = shallow_pair(random, Model(make_solid(random, kind_a)),
                                              Model(make_solid(random, kind_b)), sunk);
        const auto manifolds =
            contact_manifolds(pair.a, pair.place_a, pair.b, pair.place_b, {.margin = margin});
        for (const ModelManifold& m : manifolds) {
            expect_on_surfaces(pair, m);
            for (std::uint32_t k = 0; k < m.count; ++k)
                EXPECT_GE(m.points[k].depth, -margin - 1e-12);
        }
        met += manifolds.empty() ? 0 : 1;
        deep += deepest(manifolds) > 0 ? 1 : 0;
        if (margin == 0) {
            const bool meet = penetration(pair.a, pair.place_a, pair.b, pair.place_b).meet;
            EXPECT_EQ(manifolds.empty(), !meet);
        }
    }
    EXPECT_GT(met, cases * 9 / 10);
    EXPECT_GT(deep, cases * 8 / 10);
}

/// A boulder of two sizes; now and then a box or a ball.
Mesh rounded_body(Random& random) {
    switch (random.integer(0, 3)) {
    case 0:
        return box_mesh({-0.6, -0.5, -0.4}, {0.6, 0.5, 0.4});
    case 1:
        return sphere_mesh(0.5, 24, 12);
    default:
        return scenes::boulder(random.chance(0.5) ? 128 : 1152,
                               static_cast<std::uint64_t>(random.integer(1, 1000)));
    }
}

TEST(ModelContactsProperty, AMarginKeepsTheNormalsOfWhatMeets) {
    Random random(20261408);
    std::cout << "seed 20261408\n";
    int regions = 0, same_depth = 0;
    for (int i = 0; i < many(150); ++i) {
        const ShallowPair pair =
            shallow_pair(random, Model(make_solid(random, random.integer(0, kSolidKinds - 1))),
                         Model(make_solid(random, random.integer(0, 9))), 0.03);
        const auto without = contact_manifolds(pair.a, pair.place_a, pair.b, pair.place_b, {});
        const auto with = contact_manifolds(pair.a, pair.place_a, pair.b, pair.place_b,
                                            {.margin = random.uniform(0.001, 0.3)});
        for (const ModelManifold& m : without) {
            ++regions;
            const auto same = std::find_if(with.begin(), with.end(), [&](const ModelManifold& n) {
                return length(m.normal - n.normal) <= 1e-9;
            });
            ASSERT_NE(same, with.end()) << "round " << i;
            same_depth += std::any_of(with.begin(), with.end(), [&](const ModelManifold& n) {
                return length(m.normal - n.normal) <= 1e-9 &&
                       std::abs(m.points[0].depth - n.points[0].depth) <= 1e-9;
            });
        }
    }
    std::cout << regions << " regions, " << same_depth << " as deep\n";
    EXPECT_GT(regions, many(100));
    // Points with a gap may take the place of a point that happened to be deeper than the first.
    EXPECT_GE(same_depth, regions * 95 / 100);
}

TEST(ModelContactsProperty, TheDeepestGapIsTheDistanceAndGapsAreAlongTheNormal) {
    Random random(20261409);
    std::cout << "seed 20261409\n";
    int apart = 0, gaps = 0;
    for (int i = 0; i < many(150); ++i) {
        const double gap = random.uniform(0.001, 0.1);
        const ShallowPair pair =
            shallow_pair(random, Model(make_solid(random, random.integer(0, kSolidKinds - 1))),
                         Model(make_solid(random, random.integer(0, 9))), -gap);
        const double least = distance(pair.a, pair.place_a, pair.b, pair.place_b).distance;
        const auto found = contact_manifolds(pair.a, pair.place_a, pair.b, pair.place_b,
                                             {.margin = random.uniform(1, 3) * gap});
        if (!(least > 0) || found.empty())
            continue;
        ++apart;
        double deepest_gap = -std::numeric_limits<double>::infinity();
        for (const ModelManifold& m : found)
            for (std::uint32_t k = 0; k < m.count; ++k, ++gaps) {
                const ContactPoint& p = m.points[k];
                deepest_gap = std::max(deepest_gap, p.depth);
                EXPECT_LE(length(p.point_a - p.point_b - p.depth * m.normal), 1e-9)
                    << "round " << i;
            }
        EXPECT_NEAR(deepest_gap, -least, 1e-9) << "round " << i;
    }
    std::cout << apart << " apart, " << gaps << " points\n";
    EXPECT_GT(apart, many(100));
}

TEST(ModelContactsProperty, ShallowContactsPartAlongTheirNormals) {
    Random random(7);
    int single = 0, parted = 0, close = 0;
    const int cases = many(150);
    for (int i = 0; i < cases; ++i) {
        const ShallowPair pair =
            shallow_pair(random, Model(rounded_body(random)), Model(rounded_body(random)),
                         random.uniform(0.001, 0.01));
        const auto manifolds = contact_manifolds(pair.a, pair.place_a, pair.b, pair.place_b);
        ASSERT_FALSE(manifolds.empty());
        if (manifolds.size() != 1)
            continue;
        const ModelManifold& m = manifolds[0];
        expect_on_surfaces(pair, m);
        const double found = m.points[0].depth,
                     known = penetration(pair.a, pair.place_a, pair.b, pair.place_b).depth;
        ++single;
        // Both measure the same lens: one along the normal, one to the nearest surface.
        close += found > 0.7 * known ? 1 : 0;
        const Transform away = shifted(pair.place_b, (1.3 * found + 1e-9) * m.normal);
        parted += collide(pair.a, pair.place_a, pair.b, away).meet() ? 0 : 1;
    }
    std::cout << single << " single regions, " << parted << " parted, " << close << " as deep\n";
    EXPECT_GT(single, cases / 2);
    // Where the deepest place is off the middle of the curve, less is found.
    EXPECT_GT(parted, single * 60 / 100);
    EXPECT_GT(close, single * 60 / 100);
}

TEST(ModelContactsProperty, SwappedModelsHaveOpposedNormals) {
    Random random(8);
    int single = 0, opposed = 0;
    const int cases = many(60);
    for (int i = 0; i < cases; ++i) {
        const ShallowPair pair =
            shallow_pair(random, Model(rounded_body(random)), Model(rounded_body(random)), 0.01);
        const auto ab = contact_manifolds(pair.a, pair.place_a, pair.b, pair.place_b),
                   ba = contact_manifolds(pair.b, pair.place_b, pair.a, pair.place_a);
        EXPECT_EQ(ab.size(), ba.size());
        if (ab.size() != 1 || ba.size() != 1)
            continue;
        ++single;
        opposed += dot(ab[0].normal, ba[0].normal) < -1 + 1e-9 ? 1 : 0;
    }
    EXPECT_GT(single, cases / 2);
    EXPECT_EQ(opposed, single);
}

TEST(ModelContactsProperty, NamesStayWhileABodySlides) {
    Random random(9);
    int kept = 0, all = 0;
    for (int i = 0; i < many(20); ++i) {
        const Model ground(box_mesh({-10, -10, -1}, {10, 10, 0}));
        const Model box(box_mesh({-1, -1, -1}, {1, 1, 1}));
        const Model ball(sphere_mesh(1, 40, 20));
        const Model& body = random.chance(0.5) ? box : ball;
        const double angle = random.uniform(0, 3);
        Pose pose{{random.uniform(-5, 5), random.uniform(-5, 5), 0.96},
                  {std::cos(angle), 0, 0, std::sin(angle)}};
        std::vector<ModelManifold> last;
        for (int step = 0; step < 100; ++step) {
            pose.translation.x += 0.0015, pose.translation.y += 0.0005; // about 1 % of an edge
            const auto now = contact_manifolds(ground, {}, body, pose, {.last = &last});
            ASSERT_EQ(now.size(), 1U);
            EXPECT_EQ(now[0].region, 0U);
            if (step > 0)
                for (std::uint32_t k = 0; k < now[0].count; ++k) {
                    ++all;
                    kept +=
                        std::any_of(last[0].points.begin(), last[0].points.begin() + last[0].count,
                                    [&](const ContactPoint& p) {
                                        return p.feature == now[0].points[k].feature;
                                    })
                            ? 1
                            : 0;
                }
            last = now;
        }
    }
    std::cout << kept << " of " << all << " names stay\n";
    EXPECT_GT(all, 1000);
    EXPECT_GE(kept, all * 75 / 100);
}

bool same(const std::vector<ModelManifold>& p, const std::vector<ModelManifold>& q) {
    return std::equal(p.begin(), p.end(), q.begin(), q.end(), [](const auto& m, const auto& n) {
        return m.normal == n.normal && m.region == n.region && m.count == n.count &&
               m.status == n.status &&
               std::equal(m.points.begin(), m.points.begin() + m.count, n.points.begin(),
                          [](const ContactPoint& c, const ContactPoint& d) {
                              return c.point_a == d.point_a && c.point_b == d.point_b &&
                                     c.depth == d.depth && c.feature == d.feature;
                          });
    });
}

TEST(ModelContactsProperty, ThreadsAgreeWhateverTheyDidBefore) {
    Random random(10);
    std::vector<ShallowPair> pairs;
    pairs.reserve(24);
    for (int i = 0; i < 24; ++i)
        pairs.push_back(shallow_pair(random, Model(make_solid(random, i)),
                                     Model(make_solid(random, i / 2)), 0.1));
    using Results = std::vector<std::vector<ModelManifold>>;
    const auto run = [&](std::size_t first) {
        Results results(pairs.size());
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            const std::size_t i = (first + k) % pairs.size();
            const ShallowPair& p = pairs[i];
            results[i] = contact_manifolds(p.a, p.place_a, p.b, p.place_b, {.margin = 0.01});
        }
        return results;
    };
    const Results expected = run(0);
    std::vector<Results> found(4);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < found.size(); ++t)
        threads.emplace_back([&, t] { found[t] = run(5 * t); });
    for (std::thread& thread : threads)
        thread.join();
    for (const Results& results : found)
        for (std::size_t i = 0; i < pairs.size(); ++i)
            EXPECT_TRUE(same(results[i], expected[i])) << i;
}

} // namespace
} // namespace abut::test
