// A traversal of two trees by every kind of volume visits every pair of triangles within the bound.

#include "tests/support/simd_targets.h"
#include "tests/support/tree/traversal.h"
#include "tree/traverse_volumes.h"

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

namespace abut::test {
namespace {

constexpr std::array kKinds{Volume::sphere, Volume::kdop14, Volume::kdop18,
                            Volume::kdop26, Volume::obb,    Volume::pss,
                            Volume::lss,    Volume::rss,    Volume::ssv};

std::unique_ptr<const VolumeTree> volumes_of(const Primitives& primitives, Volume kind) {
    return build_volume_tree(kind, primitives.tree, primitives.mesh());
}

constexpr std::array kSweptKinds{Volume::sphere, Volume::pss, Volume::lss, Volume::rss,
                                 Volume::ssv};

/// The trees and frames for a traversal of a scene by volumes that can be compared.
struct Placed {
    std::unique_ptr<const VolumeTree> a, b;
    PairFrame boxes;
    VolumeFrame volumes;

    Placed(const TreeScene& s, Volume kind) : Placed(s, kind, kind) {}
    Placed(const TreeScene& s, Volume kind_a, Volume kind_b)
        : a(volumes_of(s.a, kind_a)), b(volumes_of(s.b, kind_b)),
          boxes(make_pair_frame(s.a.tree, s.world_a, s.b.tree, s.world_b)),
          volumes(make_volume_frame(*a, s.world_a, *b, s.world_b)) {}
};

class TraverseVolumes : public testing::TestWithParam<SceneKind> {};

TEST_P(TraverseVolumes, VisitsEveryPairWithinTheBound) {
    const SceneKind& kind = GetParam();
    Random random(1301);
    Tally tally;
    for (int round = 0; round < 4; ++round) {
        const TreeScene s(random, kind, 120);
        const PairTruth truth(s, kind.size);
        const Vec3 direction = random.direction();
        for (const Volume volume : kKinds) {
            const Placed placed(s, volume);
            ASSERT_TRUE(placed.volumes.valid);
            for_each_simd_target([&](const std::string& target) {
                SCOPED_TRACE(testing::Message() << "volume " << int(volume) << ' ' << target);
                PairTraversal pair{s.a.tree, s.b.tree, placed.boxes};
                const VolumeTraversal t{pair, *placed.a, *placed.b, placed.volumes};
                expect_no_pair_lost(s, truth, direction, pair, t, tally);
            });
        }
    }
    EXPECT_GT(tally.met, 300U);
    EXPECT_GT(tally.crossed, tally.met / 2);
    EXPECT_GT(tally.accepted, 0U);
    EXPECT_GT(tally.within, 1000U);
    EXPECT_LT(tally.visited, tally.total / 2);
}

TEST_P(TraverseVolumes, MixedKindsVisitEveryPairWithinTheBound) {
    const SceneKind& kind = GetParam();
    Random random(1306);
    Tally tally;
    for (const Volume kind_a : kSweptKinds)
        for (const Volume kind_b : kSweptKinds) {
            if (kind_a == kind_b)
                continue;
            const TreeScene s(random, kind, 120);
            const PairTruth truth(s, kind.size);
            const Vec3 direction = random.direction();
            const Placed placed(s, kind_a, kind_b);
            ASSERT_TRUE(placed.volumes.valid);
            for_each_simd_target([&](const std::string& target) {
                SCOPED_TRACE(testing::Message() << "volumes " << to_string(kind_a) << ' '
                                                << to_string(kind_b) << ' ' << target);
                PairTraversal pair{s.a.tree, s.b.tree, placed.boxes};
                const VolumeTraversal t{pair, *placed.a, *placed.b, placed.volumes};
                expect_no_pair_lost(s, truth, direction, pair, t, tally);
            });
        }
    EXPECT_GT(tally.met, 300U);
    EXPECT_GT(tally.crossed, tally.met / 2);
    EXPECT_GT(tally.accepted, 0U);
    EXPECT_GT(tally.within, 1000U);
    EXPECT_LT(tally.visited, tally.total / 2);
}

INSTANTIATE_TEST_SUITE_P(Kinds, TraverseVolumes, testing::ValuesIn(kSceneKinds),
                         [](const auto& tested) { return std::string(tested.param.name); });

/// Keeps the least distance, as a distance query does.
class Nearest : public LeafPairVisitor {
public:
    Nearest(const TreeScene& scene, bool stop_at_first) : s_(scene), stop_(stop_at_first) {}
    double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& pairs) override {
        ++visits;
        for_each_primitive_pair(
            s_.a.tree, leaf_a, s_.b.tree, leaf_b, pairs.any(),
            [&](std::uint32_t i, std::uint32_t j) {
                best_sq = std::min(
                    best_sq,
                    triangle_triangle_distance(s_.placed_a[i], s_.placed_b[j]).distance_sq);
            });
        return stop_ ? kStopTraversal : best_sq;
    }
    double best_sq = HUGE_VAL;
    int visits = 0;

private:
    const TreeScene& s_;
    bool stop_;
};

double distance_sq_of(const TreeScene& s) {
    double least = HUGE_VAL;
    for (const Triangle& t : s.placed_a)
        for (const Triangle& u : s.placed_b)
            least = std::min(least, triangle_triangle_distance(t, u).distance_sq);
    return least;
}

TEST(TraverseVolumes, FindsTheNearestPair) {
    Random random(1302);
    std::array<int, kKinds.size()> visits{};
    for (int round = 0; round < 40; ++round) {
        TreeScene s(random, {"rigid", 10, 1, 0, false}, 120);
        s.put_b(apply(s.world_a, s.offset_a) + 4 * random.direction());
        const double expected = distance_sq_of(s);
        for (std::size_t k = 0; k < kKinds.size(); ++k) {
            const Placed placed(s, kKinds[k]);
            PairTraversal pair{s.a.tree, s.b.tree, placed.boxes, HUGE_VAL};
            const VolumeTraversal t{pair, *placed.a, *placed.b, placed.volumes};
            Nearest nearest(s, false);
            EXPECT_EQ(traverse_nearest(t, nearest), Verdict::done);
            ASSERT_EQ(nearest.best_sq, expected);
            visits[k] += nearest.visits;
            EXPECT_GT(pair.volume_tests, 0U);
            EXPECT_GT(pair.primitive_tests, 0U);

            Nearest first(s, true);
            EXPECT_EQ(traverse_nearest(t, first), Verdict::stopped);
            EXPECT_EQ(first.visits, 1);
        }
    }
    for (const int count : visits) {
        std::cout << count << " leaf pairs\n";
        EXPECT_LT(count, 40 * 40 * 40 / 10);
    }
}

TEST(TraverseVolumes, MixedKindsFindTheNearestPair) {
    Random random(1307);
    int rounds = 0;
    std::uint64_t primitive_tests = 0, all = 0;
    for (int round = 0; round < 10; ++round)
        for (const Volume kind_a : kSweptKinds)
            for (const Volume kind_b : kSweptKinds) {
                TreeScene s(random, {"rigid", 10, 1, 0, round % 2 == 1}, 80);
                s.put_b(apply(s.world_a, s.offset_a) + 4 * random.direction());
                const Placed placed(s, kind_a, kind_b);
                PairTraversal pair{s.a.tree, s.b.tree, placed.boxes, HUGE_VAL};
                Nearest nearest(s, false);
                EXPECT_EQ(traverse_nearest({pair, *placed.a, *placed.b, placed.volumes}, nearest),
                          Verdict::done);
                ASSERT_EQ(nearest.best_sq, distance_sq_of(s))
                    << to_string(kind_a) << ' ' << to_string(kind_b);
                primitive_tests += pair.primitive_tests;
                all += 6400; // 80 times 80
                ++rounds;
            }
    std::cout << primitive_tests << " of " << all << " pairs tested\n";
    EXPECT_EQ(rounds, 250);
    EXPECT_LT(primitive_tests, all / 4);
}

TEST(TraverseVolumes, AcceptsOnlyPairsWithinTheBound) {
    Random random(1303);
    int accepted = 0, done = 0;
    for (int round = 0; round < 60; ++round) {
        TreeScene s(random, {"any", 10, 1, 0, round % 2 == 0}, 60);
        s.put_b(apply(s.world_a, s.offset_a) + random.uniform(0, 6) * random.direction());
        const double distance_sq = distance_sq_of(s);
        const double bound_sq = distance_sq * std::pow(random.uniform(0.5, 12), 2);
        for (const Volume volume : kKinds) {
            const Placed placed(s, volume);
            PairTraversal pair{s.a.tree, s.b.tree, placed.boxes, bound_sq};
            Recorder recorder(s.a.tree, s.b.tree, bound_sq);
            const Verdict verdict =
                traverse_within({pair, *placed.a, *placed.b, placed.volumes}, recorder);
            if (verdict == Verdict::accepted) {
                ++accepted;
                ASSERT_LE(distance_sq, bound_sq);
            } else {
                ASSERT_EQ(verdict, Verdict::done);
                ASSERT_TRUE(distance_sq > bound_sq || !recorder.seen.empty());
                ++done;
            }
        }
    }
    std::cout << accepted << " accepted, " << done << " done\n";
    EXPECT_GT(accepted, 40);
    EXPECT_GT(done, 40);
}

TEST(TraverseVolumes, TreesWithoutVolumes) {
    Random random(1304);
    const Primitives a(random, 20, {}, 1);
    EXPECT_EQ(volumes_of(a, Volume::aabb), nullptr);
    EXPECT_EQ(volumes_of(a, Volume::automatic), nullptr);
    EXPECT_EQ(build_volume_tree(Volume::obb, Tree(), {}), nullptr);
    const auto obb = volumes_of(a, Volume::obb), rss = volumes_of(a, Volume::rss);
    EXPECT_EQ(obb->kind(), Volume::obb);
    EXPECT_EQ(obb->bytes(), a.tree.nodes.size() * 15 * 8 * sizeof(float));
    EXPECT_FALSE(make_volume_frame(*obb, {}, *rss, {}).valid);
    const auto ssv = volumes_of(a, Volume::ssv), sphere = volumes_of(a, Volume::sphere),
               kdop = volumes_of(a, Volume::kdop18);
    EXPECT_FALSE(make_volume_frame(*obb, {}, *kdop, {}).valid);
    EXPECT_FALSE(make_volume_frame(*kdop, {}, *ssv, {}).valid);
    EXPECT_TRUE(make_volume_frame(*ssv, {}, *rss, {}).valid);
    EXPECT_TRUE(make_volume_frame(*sphere, {}, *rss, {}).valid);
    EXPECT_EQ(ssv->bytes(), rss->bytes());
    const Transform flat({1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_FALSE(make_volume_frame(*obb, {}, *obb, flat).valid);
    EXPECT_TRUE(make_volume_frame(*obb, {}, *obb, {}).valid);
}

TEST(TraverseVolumes, OneTriangleEach) {
    Random random(1305);
    int near = 0, far = 0;
    for (int i = 0; i < 300; ++i) {
        const Primitives a(random, 1, {}, 1), b(random, 1, {}, 1);
        const Transform world = random.pose(1);
        const double distance_sq =
            triangle_triangle_distance(a.triangles[0], b.placed(world)[0]).distance_sq;
        const PairFrame boxes = make_pair_frame(a.tree, {}, b.tree, world);
        for (const Volume volume : kKinds) {
            const auto va = volumes_of(a, volume), vb = volumes_of(b, volume);
            const VolumeFrame frame = make_volume_frame(*va, {}, *vb, world);
            PairTraversal pair{a.tree, b.tree, boxes, 1};
            Recorder recorder(a.tree, b.tree, 1);
            EXPECT_EQ(traverse_nearest({pair, *va, *vb, frame}, recorder), Verdict::done);
            (recorder.seen.empty() ? far : near) += 1;
            ASSERT_TRUE(distance_sq > 1 || recorder.seen.size() == 1);
        }
    }
    EXPECT_GT(near, 300);
    EXPECT_GT(far, 300);
}

} // namespace
} // namespace abut::test
