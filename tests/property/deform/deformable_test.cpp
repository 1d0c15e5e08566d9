// Impacts of deforming surfaces: all pairs of features against exact arithmetic; and every scheme,
// assignment, culling, number of threads and SIMD target against each other. Each test prints its
// seed and what it has seen.

#include <abut/deformable.h>
#include <abut/progress.h>

#include "ccd/elementary_exact.h"
#include "deform/deformable_data.h"
#include "tests/support/ccd_cases.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/oracle/ccd_oracle.h"
#include "tests/support/oracle/thickness_oracle.h"
#include "tests/support/rounds.h"
#include "tests/support/sanitizer.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>
#include <iostream>

namespace abut::test {
namespace {

MovingMesh any_soup(Random& random) {
    const int vertices = random.integer(4, 14), triangles = random.integer(1, 14);
    return random.chance(0.5) ? lattice_soup(random, vertices, triangles, random.integer(1, 4))
                              : random_soup(random, vertices, triangles);
}

std::vector<DeformableOptions> all_options() {
    std::vector<DeformableOptions> all;
    for (const auto scheme : {Scheme::representative, Scheme::database, Scheme::markup,
                              Scheme::basic, Scheme::features, Scheme::pairwise})
        for (const auto culling : {Culling::tree, Culling::grid, Culling::sweep})
            all.push_back({scheme, Assignment::greedy, culling});
    for (const auto assignment : {Assignment::maximal, Assignment::uniform_vertex_edge,
                                  Assignment::uniform_edge_edge, Assignment::adaptive})
        all.push_back({Scheme::representative, assignment, Culling::tree});
    all.push_back({.lean = true});
    return all;
}

TEST(Deformable, EveryPairAgainstExactArithmetic) {
    Random random(2008);
    std::size_t cases = 0, hits = 0, by_oracle = 0;
    while (cases < std::size_t(many(400'000))) {
        const MovingMesh moving = any_soup(random);
        const Impacts impacts = self_impacts(moving.deformable());
        auto next = impacts.list.begin();
        std::vector<std::pair<FeatureImpact, ElementaryPair>> pairs;
        for_each_feature_pair(moving, moving,
                              [&](const FeatureImpact& ids, const ElementaryPair& pair) {
                                  pairs.emplace_back(ids, pair);
                              });
        std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
            return list_order(a.first) < list_order(b.first);
        });
        for (const auto& [ids, pair] : pairs) {
            const bool found = next != impacts.list.end() && list_order(*next) == list_order(ids);
            const ElementaryImpact truth = elementary_impact_exact(pair);
            ASSERT_EQ(found, truth.meet) << pair;
            if (cases++ % 64 == 0) {
                ++by_oracle;
                ASSERT_EQ(found, CcdOracle<AnyInt>(pair).first().has_value()) << pair;
            }
            if (!found)
                continue;
            ++hits;
            EXPECT_NEAR(next->time, truth.time, 1e-9) << pair;
            ++next;
        }
        ASSERT_EQ(next, impacts.list.end());
    }
    std::cout << cases << " pairs, " << hits << " hits, " << by_oracle << " also by the oracle\n";
    EXPECT_GT(hits, cases / 20);
    EXPECT_LT(hits, cases / 2);
}

TEST(Deformable, EveryOptionEqualsSingleTests) {
    Random random(41);
    std::size_t pairs = 0, hits = 0;
    for (int round = 0; round < many(60); ++round) {
        const MovingMesh moving = round % 3 == 0 ? crumpled_sheet(random, 6) : any_soup(random);
        const BruteForceImpacts truth(moving, moving);
        pairs += truth.pairs;
        hits += truth.list.size();
        for (const DeformableOptions& options : all_options()) {
            Deformable surface = moving.deformable(options);
            const Impacts impacts = self_impacts(surface);
            ASSERT_EQ(impacts.list, truth.list)
                << int(options.scheme) << ' ' << int(options.assignment) << ' '
                << int(options.culling);
            if (options.assignment != Assignment::adaptive)
                continue;
            surface.adapt(impacts);
            ASSERT_EQ(self_impacts(surface).list, truth.list);
        }
    }
    std::cout << pairs << " pairs, " << hits << " hits\n";
    EXPECT_GT(hits, 500U);
}

TEST(Deformable, TwoSurfacesEqualSingleTests) {
    Random random(97);
    std::size_t pairs = 0, hits = 0, face_first = 0;
    for (int round = 0; round < many(60); ++round) {
        const MovingMesh a = any_soup(random), b = any_soup(random);
        const BruteForceImpacts truth(a, b);
        pairs += truth.pairs;
        hits += truth.list.size();
        for (const FeatureImpact& impact : truth.list)
            face_first += impact.face_first ? 1 : 0;
        for (const DeformableOptions& options : all_options())
            ASSERT_EQ(impacts(a.deformable(options), b.deformable(options)).list, truth.list)
                << int(options.scheme) << ' ' << int(options.assignment) << ' '
                << int(options.culling);
    }
    std::cout << pairs << " pairs, " << hits << " hits, " << face_first << " face first\n";
    EXPECT_GT(hits, pairs / 50);
    EXPECT_LT(hits, pairs / 2);
    EXPECT_GT(face_first, hits / 10);
}

TEST(Deformable, AllSchemesAgreeOnLargerSurfaces) {
    Random random(11);
    std::size_t hits = 0;
    for (int round = 0; round < many(reduced_for_threads(4, 1)); ++round) {
        const MovingMesh moving = crumpled_sheet(random, 40);
        const Impacts truth = self_impacts(moving.deformable({.scheme = Scheme::basic}));
        hits += truth.list.size();
        for (const DeformableOptions& options : all_options())
            ASSERT_EQ(self_impacts(moving.deformable(options)).list, truth.list);
    }
    std::cout << hits << " hits\n";
    EXPECT_GT(hits, 100U);
}

/// Every elementary test runs once. Representatives spawn exactly the tests that remain after a
/// database has removed duplicates, or fewer where a region is flat.
TEST(Deformable, SpawnsNoPairTwice) {
    Random random(5);
    for (int round = 0; round < many(20); ++round) {
        const MovingMesh moving = crumpled_sheet(random, 12);
        const auto counters = [&](const DeformableOptions& options) {
            return self_impacts(moving.deformable(options)).counters;
        };
        const DeformableCounters database = counters({.scheme = Scheme::database}),
                                 features = counters({.scheme = Scheme::features}),
                                 markup = counters({.scheme = Scheme::markup}),
                                 grid = counters({.culling = Culling::grid}),
                                 pairwise = counters({.scheme = Scheme::pairwise}),
                                 representative = counters({}),
                                 basic = counters({.scheme = Scheme::basic});
        EXPECT_EQ(features.elementary_tests, database.elementary_tests);
        EXPECT_EQ(markup.elementary_tests, database.elementary_tests);
        EXPECT_EQ(grid.elementary_tests, database.elementary_tests);
        EXPECT_EQ(grid.candidates, database.candidates);
        EXPECT_EQ(pairwise.candidates, database.candidates);
        EXPECT_EQ(pairwise.triangle_pairs, basic.triangle_pairs);
        EXPECT_LE(representative.elementary_tests.edge_edge, database.elementary_tests.edge_edge);
        EXPECT_GT(basic.elementary_tests.edge_edge, database.elementary_tests.edge_edge);
        EXPECT_GT(markup.candidates.edge_edge, database.candidates.edge_edge);
        EXPECT_GT(basic.candidates.edge_edge, markup.candidates.edge_edge);
    }
}

TEST(Deformable, FirstImpactIsTheEarliest) {
    Random random(23);
    int with = 0, without = 0;
    for (int round = 0; round < many(400); ++round) {
        const MovingMesh a = any_soup(random), b = random_soup(random, 6, 4);
        const Deformable surface = a.deformable(), other = b.deformable();
        const auto check = [&](const Impacts& all, const std::optional<FeatureImpact>& first,
                               bool is_free) {
            ASSERT_EQ(first.has_value(), !all.list.empty());
            ASSERT_EQ(is_free, all.list.empty());
            (first ? with : without) += 1;
            if (!first)
                return;
            const auto earliest = std::min_element(
                all.list.begin(), all.list.end(),
                [](const FeatureImpact& i, const FeatureImpact& k) { return i.time < k.time; });
            EXPECT_EQ(*first, *earliest);
        };
        check(self_impacts(surface), self_time_of_impact(surface),
              is_free_of_self_impacts(surface));
        check(impacts(surface, other), time_of_impact(surface, other),
              is_free_of_impacts(surface, other));
    }
    std::cout << with << " with impacts, " << without << " without\n";
    EXPECT_GT(with, many(400) / 5);
    EXPECT_GT(without, many(400) / 5);
}

/// Whatever the tolerances and wherever the surfaces are, and also where most pairs of nodes do not
/// overlap at the start: the earliest impact is that of the list, for any number of threads.
TEST(Deformable, FirstImpactIsTheEarliestOfEveryList) {
    Random random(31);
    int with = 0, without = 0, after_start = 0;
    for (int round = 0; round < many(60); ++round) {
        MovingMesh a = round % 4 == 0 ? crumpled_sheet(random, 20) : any_soup(random),
                   b = round % 4 == 0 ? crumpled_sheet(random, 12) : random_soup(random, 8, 6);
        const double scale = std::ldexp(1, random.integer(-40, 40));
        const Vec3 far = random.chance(0.5) ? Vec3{} : (1e6 * scale) * random.in_cube();
        const Vec3 beside = random.chance(0.5) ? Vec3{} : (2 * scale) * random.in_cube();
        for (auto* points : {&a.mesh.positions, &a.end})
            for (Vec3& p : *points)
                p = scale * p + far;
        for (auto* points : {&b.mesh.positions, &b.end})
            for (Vec3& p : *points)
                p = scale * p + far + (points == &b.end ? Vec3{} : beside);
        const Deformable surface = a.deformable(), other = b.deformable();
        for (const ElementaryOptions& options :
             {ElementaryOptions{}, ElementaryOptions{.absolute_error = 0.05 * scale},
              ElementaryOptions{.thickness = 0.05 * scale}}) {
            const auto check = [&](const Impacts& all, const std::optional<FeatureImpact>& first) {
                const auto earliest = std::min_element(
                    all.list.begin(), all.list.end(),
                    [](const FeatureImpact& i, const FeatureImpact& k) { return i.time < k.time; });
                ASSERT_EQ(first.has_value(), !all.list.empty());
                if (first) {
                    ASSERT_EQ(*first, *earliest);
                }
                (first ? with : without) += 1;
                after_start += first && first->time > 0 ? 1 : 0;
            };
            for (const int threads : {1, 4}) {
                set_threads(threads);
                check(self_impacts(surface, options), self_time_of_impact(surface, options));
                check(impacts(surface, other, options), time_of_impact(surface, other, options));
            }
            set_threads(0);
        }
    }
    std::cout << with << " with impacts, " << without << " without, " << after_start
              << " not at the start\n";
    EXPECT_GT(with, many(60));
    EXPECT_GT(after_start, many(60) / 4);
}

TEST(Deformable, ThreadsAndTargetsChangeNothing) {
    Random random(71);
    const MovingMesh moving = crumpled_sheet(random, 60);
    const Impacts truth = self_impacts(moving.deformable());
    EXPECT_GT(truth.list.size(), 50U);
    for (const int threads : {1, 2, 5}) {
        set_threads(threads);
        const Impacts impacts = self_impacts(moving.deformable());
        EXPECT_EQ(impacts.list, truth.list) << threads;
        EXPECT_EQ(impacts.counters, truth.counters) << threads;
    }
    set_threads(0);
    // Targets without fused operations round times differently.
    for_each_simd_target([&](const std::string& name) {
        const Impacts impacts = self_impacts(moving.deformable());
        EXPECT_EQ(impacts.counters.candidates, truth.counters.candidates) << name;
        ASSERT_EQ(impacts.list.size(), truth.list.size()) << name;
        for (std::size_t i = 0; i < truth.list.size(); ++i) {
            EXPECT_EQ(list_order(impacts.list[i]), list_order(truth.list[i])) << name;
            EXPECT_NEAR(impacts.list[i].time, truth.list[i].time, 1e-9) << name;
        }
    });
}

/// A sequence of steps on a refitted surface equals surfaces that are built anew for each step.
TEST(Deformable, StepsEqualNewSurfaces) {
    Random random(3);
    std::size_t hits = 0;
    for (int round = 0; round < many(10); ++round) {
        MovingMesh moving = crumpled_sheet(random, 10);
        Deformable surface(moving.mesh);
        surface.set_motion(moving.mesh.positions, moving.end);
        for (int step = 0; step < 10; ++step) {
            const Impacts truth = self_impacts(moving.deformable());
            ASSERT_EQ(self_impacts(surface).list, truth.list);
            hits += truth.list.size();
            moving.mesh.positions = moving.end;
            // A large step makes the surface rebuild its hierarchy at some time.
            for (Vec3& p : moving.end)
                p = p + random.in_cube(step == 5 ? 1 : 0.05);
            if (step % 2 == 0)
                surface.advance(moving.end);
            else
                surface.advance(std::vector<Vec3>(moving.end));
        }
    }
    std::cout << hits << " hits\n";
    EXPECT_GT(hits, 1000U);
}

/// Half the area of all boxes of nodes and leaves that are smaller than `largest`.
double area_of_boxes(const Deformable& surface, double largest) {
    double sum = 0;
    for (const MovingNode& node : surface.data().swept.tree.nodes)
        for (std::size_t i = 0; i < MovingNode::kWidth && !node.child[i].is_none(); ++i) {
            const double area{moving_tree::box_of(node, i).swept().half_area()};
            sum += area < largest ? area : 0;
        }
    return sum;
}

/// Triangles that scatter from one surface must not leave boxes that span them all, even beside
/// much larger triangles at rest.
TEST(Deformable, HierarchyFollowsScatteringTriangles) {
    Random random(13);
    MovingMesh moving;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        const Vec3 at = random.in_cube();
        for (int k = 0; k < 3; ++k)
            moving.mesh.positions.push_back(at + random.in_cube(0.02));
        moving.mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    for (const Vec3& p : {Vec3{-1e3, -1e3, -2}, Vec3{1e3, -1e3, -2}, Vec3{0, 1e3, -2}})
        moving.mesh.positions.push_back(p);
    moving.mesh.triangles.push_back({9000, 9001, 9002});
    Deformable surface(moving.mesh);
    std::vector<Vec3> flight(3000);
    for (Vec3& each : flight)
        each = random.in_cube(0.3);
    std::vector<Vec3> at = moving.mesh.positions;
    for (int step = 0; step < 10; ++step) {
        for (std::size_t i = 0; i < 9000; ++i)
            at[i] = at[i] + flight[i / 3];
        surface.advance(at);
    }
    Mesh scattered = moving.mesh;
    scattered.positions = at;
    Deformable anew(scattered);
    surface.advance(at);
    constexpr double kPieces = 1e5; // the large triangle's box has about 4e6
    EXPECT_LT(area_of_boxes(surface, kPieces), 1.5 * area_of_boxes(anew, kPieces));
}

/// Triangles are removed, added, turned and re-indexed between steps.
TEST(Deformable, ChangedTopologyEqualsNewSurfaces) {
    Random random(19);
    std::size_t hits = 0;
    for (int round = 0; round < many(100); ++round) {
        MovingMesh moving = random_soup(random, 12, 12);
        Deformable surface(moving.mesh);
        for (int change = 0; change < 5; ++change) {
            auto& triangles = moving.mesh.triangles;
            for (auto& t : triangles)
                if (random.chance(0.2))
                    t = any_triangles(random, 12, 1)[0];
            if (random.chance(0.5))
                triangles.pop_back();
            else
                triangles.push_back(any_triangles(random, 12, 1)[0]);
            surface.set_mesh(moving.mesh);
            surface.set_motion(moving.mesh.positions, moving.end);
            const Impacts truth = self_impacts(moving.deformable());
            ASSERT_EQ(self_impacts(surface).list, truth.list);
            hits += truth.list.size();
        }
    }
    std::cout << hits << " hits\n";
    EXPECT_GT(hits, 1000U);
}

/// A conservative answer contains the whole exact answer.
TEST(Deformable, ConservativeModeMissesNoImpact) {
    Random random(67);
    std::size_t hits = 0;
    for (int round = 0; round < many(60); ++round) {
        const MovingMesh moving = any_soup(random);
        const Deformable surface = moving.deformable();
        const Impacts exact = self_impacts(surface),
                      all = self_impacts(surface, {.absolute_error = 0.1});
        ASSERT_TRUE(std::includes(all.list.begin(), all.list.end(), exact.list.begin(),
                                  exact.list.end(),
                                  [](const FeatureImpact& a, const FeatureImpact& b) {
                                      return list_order(a) < list_order(b);
                                  }));
        hits += exact.list.size();
    }
    std::cout << hits << " hits\n";
    EXPECT_GT(hits, 500U);
}

TEST(Deformable, ThicknessEqualsSingleTests) {
    Random random(83);
    std::size_t pairs = 0, hits = 0, more = 0;
    for (int round = 0; round < many(30); ++round) {
        const MovingMesh moving = any_soup(random), other = any_soup(random);
        const ElementaryOptions thick{.thickness = random.uniform(0.01, 0.3)};
        const BruteForceImpacts truth(moving, moving, thick), between(moving, other, thick);
        pairs += truth.pairs + between.pairs;
        hits += truth.list.size() + between.list.size();
        more += truth.list.size() - self_impacts(moving.deformable()).list.size();
        for (const DeformableOptions& options : all_options()) {
            const Deformable a = moving.deformable(options), b = other.deformable(options);
            ASSERT_EQ(self_impacts(a, thick).list, truth.list);
            ASSERT_EQ(impacts(a, b, thick).list, between.list);
            ASSERT_EQ(is_free_of_self_impacts(a, thick), truth.list.empty());
            const auto first = self_time_of_impact(a, thick);
            ASSERT_EQ(first.has_value(), !truth.list.empty());
        }
    }
    std::cout << pairs << " pairs, " << hits << " hits, " << more << " by thickness\n";
    EXPECT_GT(hits, pairs / 20);
    EXPECT_LT(hits, pairs * 9 / 10);
    EXPECT_GT(more, 50U);
}

TEST(Deformable, PairsWithinEqualAllDistances) {
    Random random(61);
    std::size_t pairs = 0, found = 0;
    for (int round = 0; round < many(100); ++round) {
        double distance = random.chance(0.2) ? 0 : random.uniform(0, 0.5);
        MovingMesh a = any_soup(random), b = any_soup(random);
        if (round % 4 == 0) { // squares, or bounds in single precision, underflow
            const double scale = std::ldexp(1, random.integer(-1000, -140));
            for (MovingMesh* m : {&a, &b})
                for (auto* positions : {&m->mesh.positions, &m->end})
                    for (Vec3& p : *positions)
                        p = scale * p;
            distance *= scale;
        }
        const auto check = [&](const MovingMesh& first, const MovingMesh& second,
                               const std::vector<FeaturePair>& near) {
            std::vector<FeatureImpact> expected;
            for_each_feature_pair(first, second,
                                  [&](const FeatureImpact& ids, const ElementaryPair& pair) {
                                      ++pairs;
                                      if (ThicknessOracle(pair).within(distance, 0))
                                          expected.push_back(ids);
                                  });
            std::sort(expected.begin(), expected.end(),
                      [](const auto& p, const auto& q) { return list_order(p) < list_order(q); });
            ASSERT_EQ(near.size(), expected.size());
            for (std::size_t i = 0; i < near.size(); ++i) {
                EXPECT_EQ(std::tuple(near[i].kind, near[i].face_first, near[i].a, near[i].b),
                          list_order(expected[i]));
                EXPECT_LE(near[i].distance, distance);
            }
            found += near.size();
        };
        // The answer does not depend on the motion. The distance of a pair that was found is tried
        // again, exactly and a few units in the last place off: pairs at that distance are within
        // it, and not within less.
        const Deformable first = a.deformable(), second = b.deformable();
        check(a, a, self_within(first, distance));
        check(a, b, within(first, second, distance));
        if (auto near = within(first, second, distance); !near.empty()) {
            distance = near[std::size_t(random.integer(0, int(near.size()) - 1))].distance;
            for (int i = random.integer(-1, 1); i != 0; i += i < 0 ? 1 : -1)
                distance = std::max(0.0, std::nextafter(distance, i < 0 ? -HUGE_VAL : HUGE_VAL));
            check(a, b, within(first, second, distance));
            check(a, a, self_within(first, distance));
        }
    }
    std::cout << pairs << " pairs, " << found << " near\n";
    EXPECT_GT(found, pairs / 20);
    EXPECT_LT(found, pairs * 3 / 4);
}

} // namespace
} // namespace abut::test
