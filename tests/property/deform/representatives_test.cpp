// Representatives with a culling of the caller's: the tests are those that meet, each once; changes
// of the triangles leave every feature with one representative.

#include <abut/representatives.h>

#include "mesh/changing_surface.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iostream>
#include <set>
#include <tuple>

namespace abut::test {
namespace {

MovingMesh any_moving(Random& random) {
    const int vertices = random.integer(4, 14), triangles = random.integer(1, 14);
    return random.chance(0.3)   ? crumpled_sheet(random, 5)
           : random.chance(0.5) ? lattice_soup(random, vertices, triangles, random.integer(1, 4))
                                : random_soup(random, vertices, triangles);
}

Representatives representatives_of(const MovingMesh& moving, Assignment assignment, bool boxes) {
    Representatives surface(moving.mesh.positions.size(), moving.mesh.triangles, assignment);
    if (boxes)
        surface.set_motion(moving.mesh.positions, moving.end);
    return surface;
}

Box3 swept_box(const MovingMesh& moving, std::size_t triangle) {
    Box3 box;
    for (const std::uint32_t v : moving.mesh.triangles[triangle]) {
        extend(box, moving.mesh.positions[v]);
        extend(box, moving.end[v]);
    }
    return box;
}

/// The culling of the caller: all pairs of triangles whose swept boxes overlap, in any order.
std::vector<TrianglePair> overlapping_triangles(const MovingMesh& a, const MovingMesh& b,
                                                Random& random) {
    std::vector<TrianglePair> pairs;
    for (std::uint32_t i = 0; i < a.mesh.triangles.size(); ++i)
        for (std::uint32_t k = &a == &b ? i + 1 : 0; k < b.mesh.triangles.size(); ++k) {
            const Box3 p = swept_box(a, i), q = swept_box(b, k);
            const Vec3 gap = max(p.lower - q.upper, q.lower - p.upper);
            if (std::max({gap.x, gap.y, gap.z}) <= 0)
                pairs.push_back(&a == &b && random.chance(0.5) ? TrianglePair{k, i}
                                                               : TrianglePair{i, k});
        }
    for (std::size_t i = pairs.size(); i > 1; --i)
        std::swap(pairs[i - 1],
                  pairs[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
    return pairs;
}

ElementaryPair pair_of(const FeatureTest& test, const MovingMesh& a, const MovingMesh& b) {
    ElementaryPair pair{test.kind, {}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t of_a = test.kind == ElementaryKind::edge_edge ? 2 : 1;
        const MovingMesh& of = (i < of_a) != test.face_first ? a : b;
        pair.start[i] = of.mesh.positions[test.vertices[i]];
        pair.end[i] = of.end[test.vertices[i]];
    }
    return pair;
}

using Key = std::tuple<ElementaryKind, bool, std::uint32_t, std::uint32_t>;

/// The tests' impacts. No pair of features is tested twice.
std::set<Key> impacts_of(const std::vector<FeatureTest>& tests, const MovingMesh& a,
                         const MovingMesh& b) {
    std::set<Key> tested, met;
    for (const FeatureTest& test : tests) {
        const Key key{test.kind, test.face_first, test.a, test.b};
        EXPECT_TRUE(tested.insert(key).second) << test.a << ' ' << test.b;
        if (elementary_impact(pair_of(test, a, b)).meet)
            met.insert(key);
    }
    return met;
}

std::set<Key> keys_of(const std::vector<FeatureImpact>& list) {
    std::set<Key> keys;
    for (const FeatureImpact& impact : list)
        keys.insert({impact.kind, impact.face_first, impact.a, impact.b});
    return keys;
}

TEST(AnyCulling, TestsAreTheImpactsEachOnce) {
    Random random(2222);
    std::size_t hits = 0, with_boxes = 0, without = 0;
    for (int round = 0; round < many(120); ++round) {
        const MovingMesh a = any_moving(random), b = any_moving(random);
        const auto assignment = static_cast<Assignment>(round % 5);
        for (const bool boxes : {false, true}) {
            const Representatives ra = representatives_of(a, assignment, boxes),
                                  rb = representatives_of(b, assignment, boxes);
            const auto tests = self_feature_tests(ra, overlapping_triangles(a, a, random));
            const std::set<Key> truth = keys_of(BruteForceImpacts(a, a).list);
            ASSERT_EQ(impacts_of(tests, a, a), truth);
            const auto between = feature_tests(ra, rb, overlapping_triangles(a, b, random));
            ASSERT_EQ(impacts_of(between, a, b), keys_of(BruteForceImpacts(a, b).list));
            hits += truth.size();
            (boxes ? with_boxes : without) += tests.size() + between.size();
        }
    }
    std::cout << hits << " hits in " << without << " tests, with boxes of features " << with_boxes
              << '\n';
    EXPECT_GT(hits, std::size_t(many(120)) * 4);
    EXPECT_LT(with_boxes, without);
}

/// A motion within a margin: pairs that come near each other are tested.
TEST(AnyCulling, MarginKeepsWhatIsNear) {
    Random random(77);
    std::size_t near = 0, tests_made = 0;
    for (int round = 0; round < many(60); ++round) {
        MovingMesh a = any_moving(random);
        a.end = a.mesh.positions;
        const double margin = random.uniform(0, 0.3);
        std::vector<TrianglePair> all;
        for (std::uint32_t i = 0; i < a.mesh.triangles.size(); ++i)
            for (std::uint32_t k = i + 1; k < a.mesh.triangles.size(); ++k)
                all.push_back({i, k});
        const auto tests =
            self_feature_tests(representatives_of(a, Assignment::greedy, true), all, margin);
        std::set<Key> tested;
        for (const FeatureTest& test : tests)
            tested.insert({test.kind, test.face_first, test.a, test.b});
        tests_made += tested.size();
        for (const FeaturePair& pair : self_within(a.deformable(), margin)) {
            ++near;
            ASSERT_TRUE(tested.contains({pair.kind, pair.face_first, pair.a, pair.b}));
        }
    }
    std::cout << near << " near pairs in " << tests_made << " tests\n";
    EXPECT_GT(near, std::size_t(many(60)) * 10);
    EXPECT_LT(near, tests_made);
}

/// What a change leaves is what a surface made anew has, but for the numbers of edges and for
/// features that their triangles keep.
void expect_consistent(const ChangingSurface& surface) {
    const SurfaceFeatures fresh = make_surface_features(surface.vertices(), surface.triangles());
    std::set<std::array<std::uint32_t, 2>> edges(surface.edges().begin(), surface.edges().end());
    edges.erase({kNoEdge, kNoEdge});
    ASSERT_EQ(edges,
              (std::set<std::array<std::uint32_t, 2>>(fresh.edges.begin(), fresh.edges.end())));
    std::vector<int> vertices(surface.vertices()), used(surface.vertices()),
        owners(surface.edges().size());
    for (std::size_t i = 0; i < surface.triangles().size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t edge = surface.edges_of()[i][k], truth = fresh.edges_of[i][k];
            ASSERT_EQ(edge == kNoEdge, truth == kNoEdge);
            if (edge != kNoEdge) {
                ASSERT_EQ(surface.edges()[edge], fresh.edges[truth]);
            }
            used[surface.triangles()[i][k]] = 1;
            vertices[surface.triangles()[i][k]] +=
                represents_vertex(surface.represented()[i], k) ? 1 : 0;
            if (represents_edge(surface.represented()[i], k))
                ++owners[edge];
        }
    EXPECT_EQ(vertices, used);
    for (std::size_t i = 0; i < owners.size(); ++i)
        EXPECT_EQ(owners[i], surface.edges()[i][0] == kNoEdge ? 0 : 1);
}

TEST(AnyCulling, ChangesLeaveOneRepresentativeEach) {
    Random random(909);
    std::size_t kept = 0, changed = 0;
    for (int round = 0; round < many(200); ++round) {
        int vertices = random.integer(1, 20);
        std::vector<IndexTriangle> now = any_triangles(random, vertices, random.integer(0, 30));
        ChangingSurface surface(static_cast<std::size_t>(vertices), now,
                                static_cast<Assignment>(round % 5));
        for (int step = 0; step < 6; ++step) {
            const std::vector<IndexTriangle> before = now;
            const std::vector<IndexTriangle> edges_before = surface.edges_of();
            vertices = std::max(1, vertices + random.integer(-3, 3));
            now.resize(static_cast<std::size_t>(
                std::max(0, static_cast<int>(now.size()) + random.integer(-5, 5))));
            for (IndexTriangle& triangle : now)
                if (random.chance(0.3) || std::max({triangle[0], triangle[1], triangle[2]}) >=
                                              static_cast<std::uint32_t>(vertices))
                    triangle = any_triangles(random, vertices, 1)[0];
            std::vector<Represented> expected(now.size());
            for (std::size_t i = 0; i < std::min(now.size(), before.size()); ++i)
                if (now[i] == before[i])
                    expected[i] = surface.represented()[i];
            surface.set(static_cast<std::size_t>(vertices), now);
            ASSERT_EQ(surface.triangles(), now);
            expect_consistent(surface);
            for (std::size_t i = 0; i < std::min(now.size(), before.size()); ++i) {
                (now[i] == before[i] ? kept : changed) += 1;
                if (now[i] == before[i]) {
                    ASSERT_EQ(surface.edges_of()[i], edges_before[i]);
                }
            }
            const SurfaceFeatures fresh = make_surface_features(surface.vertices(), now);
            complete_assignment({surface.vertices(), now, fresh}, expected);
            ASSERT_EQ(surface.represented(), expected);
        }
    }
    std::cout << kept << " triangles kept, " << changed << " changed\n";
    EXPECT_GT(kept, std::size_t(many(200)) * 20);
    EXPECT_GT(changed, std::size_t(many(200)) * 10);
}

} // namespace
} // namespace abut::test
