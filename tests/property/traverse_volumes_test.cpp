// A traversal of two trees by volumes of every kind against all pairs of triangles: none within the
// bound may be lost.

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "tests/support/random.h"
#include "tests/support/simd_targets.h"
#include "tree/traverse_volumes.h"

#include <gtest/gtest.h>
#include <set>
#include <string>

namespace abut::test {
namespace {

constexpr std::array kKinds{Volume::sphere, Volume::kdop14, Volume::kdop18, Volume::kdop26,
                            Volume::obb,    Volume::pss,    Volume::lss,    Volume::rss};

/// Triangles with a tree in their own frame.
struct Primitives {
    std::vector<Triangle> triangles;
    Tree tree;

    Primitives(Random& random, int count, const Vec3& middle, double scale) {
        std::vector<Aabb> boxes;
        for (int i = 0; i < count; ++i) {
            const Vec3 p = middle + random.in_cube(scale);
            const double size = scale * std::pow(10, random.uniform(-3, -0.5));
            triangles.push_back({p, p + random.in_cube(size), p + random.in_cube(size)});
            if (i % 10 == 0)
                triangles.back()[2] = triangles.back()[i % 20 == 0 ? 0 : 1];
            Box3 box;
            for (const Vec3& v : triangles.back())
                extend(box, v);
            boxes.emplace_back(box);
        }
        tree = build_tree(boxes);
    }
    [[nodiscard]] std::unique_ptr<const VolumeTree> volumes(Volume kind) const {
        return build_volume_tree(kind, tree, triangles, 0);
    }
    [[nodiscard]] std::vector<Triangle> placed(const Transform& world) const {
        std::vector<Triangle> result = triangles;
        for (Triangle& t : result)
            for (Vec3& p : t)
                p = apply(world, p);
        return result;
    }
};

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

class Recorder : public LeafPairVisitor {
public:
    Recorder(const Tree& a, const Tree& b, double bound_sq) : a_(a), b_(b), bound_sq_(bound_sq) {}
    double visit(NodeRef leaf_a, NodeRef leaf_b) override {
        for (std::uint32_t i = 0; i < leaf_a.count(); ++i)
            for (std::uint32_t j = 0; j < leaf_b.count(); ++j)
                seen.emplace(a_.order[leaf_a.first() + i], b_.order[leaf_b.first() + j]);
        return bound_sq_;
    }
    Pairs seen;

private:
    const Tree& a_;
    const Tree& b_;
    double bound_sq_;
};

/// Pairs whose distance is at most the bound.
Pairs near_pairs(const std::vector<Triangle>& a, const std::vector<Triangle>& b, double bound) {
    Pairs pairs;
    for (std::uint32_t i = 0; i < a.size(); ++i)
        for (std::uint32_t j = 0; j < b.size(); ++j) {
            Box3 box_a, box_b;
            for (std::size_t k = 0; k < 3; ++k)
                extend(box_a, a[i][k]), extend(box_b, b[j][k]);
            if (!overlap(box_a, box_b, bound))
                continue;
            if (triangle_triangle_intersect(a[i], b[j]) != TriangleContact::none ||
                triangle_triangle_distance(a[i], b[j]).distance_sq <= bound * bound)
                pairs.emplace(i, j);
        }
    return pairs;
}

struct Kind {
    const char* name;
    double reach;        ///< of translations
    double size;         ///< of both models
    double model_offset; ///< of the models from their own origins
    bool affine;
};

Transform placement(Random& random, const Kind& kind) {
    Transform t = random.pose(0);
    if (kind.affine) {
        const double mirror = random.chance(0.5) ? -1 : 1;
        t = compose(t, Transform({mirror * random.uniform(0.2, 3), random.uniform(-1, 1), 0,
                                  random.uniform(-1, 1), random.uniform(0.2, 3), 0, 0,
                                  random.uniform(-1, 1), random.uniform(0.2, 3), 0, 0, 0}));
    }
    return t;
}

/// Two sets of triangles near one place of the world.
struct Scene {
    Vec3 offset_a, offset_b;
    Primitives a, b;
    Transform world_a, world_b;
    std::vector<Triangle> placed_a, placed_b;

    Scene(Random& random, const Kind& kind, int count)
        : offset_a(random.in_cube(kind.model_offset)), offset_b(random.in_cube(kind.model_offset)),
          a(random, count, offset_a, kind.size), b(random, count, offset_b, kind.size),
          world_a(placement(random, kind)), world_b(placement(random, kind)) {
        const Vec3 place = random.in_cube(kind.reach);
        put(world_a, offset_a, place);
        put(world_b, offset_b, place + random.in_cube(0.8 * kind.size));
        placed_a = a.placed(world_a), placed_b = b.placed(world_b);
    }
    static void put(Transform& t, const Vec3& middle, const Vec3& at) {
        const Vec3 shift = at - apply_linear(t, middle);
        t.m[9] = shift.x, t.m[10] = shift.y, t.m[11] = shift.z;
    }
};

class TraverseVolumes : public testing::TestWithParam<Kind> {};

TEST_P(TraverseVolumes, VisitsEveryPairWithinTheBound) {
    const Kind& kind = GetParam();
    Random random(1301);
    std::size_t within = 0, visited = 0, total = 0;
    for (int round = 0; round < 5; ++round) {
        const Scene s(random, kind, 150);
        for (const double bound : {0.0, 0.01 * kind.size, 0.2 * kind.size}) {
            const Pairs truth = near_pairs(s.placed_a, s.placed_b, bound);
            for (const Volume volume : kKinds) {
                SCOPED_TRACE(testing::Message() << "volume " << int(volume) << " bound " << bound);
                const auto va = s.a.volumes(volume), vb = s.b.volumes(volume);
                const VolumeFrame frame = make_volume_frame(*va, s.world_a, *vb, s.world_b);
                ASSERT_TRUE(frame.valid);
                for_each_simd_target([&](const std::string& target) {
                    VolumeTraversal depth{s.a.tree, *va, s.b.tree, *vb, frame, bound * bound},
                        best = depth;
                    Recorder in_depth(s.a.tree, s.b.tree, bound * bound),
                        nearest_first(s.a.tree, s.b.tree, bound * bound);
                    EXPECT_EQ(traverse_depth_first(depth, in_depth), Verdict::done);
                    EXPECT_EQ(traverse_best_first(best, nearest_first), Verdict::done);
                    ASSERT_EQ(in_depth.seen, nearest_first.seen) << target;
                    ASSERT_EQ(depth.volume_tests, best.volume_tests);
                    for (const auto& pair : truth)
                        ASSERT_TRUE(in_depth.seen.contains(pair)) << target;
                    within += truth.size();
                    visited += in_depth.seen.size();
                    total += s.a.triangles.size() * s.b.triangles.size();
                });
            }
        }
    }
    EXPECT_GT(within, 1000U);
    EXPECT_LT(visited, total / 2);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, TraverseVolumes,
    testing::Values(Kind{"rigid", 10, 1, 0, false}, Kind{"affine", 10, 1, 0, true},
                    Kind{"far_in_the_world", 1e5, 1, 0, false}, Kind{"far_affine", 1e5, 1, 0, true},
                    Kind{"far_in_the_model", 10, 1, 1e3, false}, Kind{"tiny", 0, 1e-6, 0, true},
                    Kind{"huge", 1e6, 1e6, 0, true}),
    [](const auto& tested) { return std::string(tested.param.name); });

/// Keeps the least distance, as a query does.
class Nearest : public LeafPairVisitor {
public:
    Nearest(const Scene& scene, bool stop_at_first) : s_(scene), stop_(stop_at_first) {}
    double visit(NodeRef leaf_a, NodeRef leaf_b) override {
        ++visits;
        for (std::uint32_t i = 0; i < leaf_a.count(); ++i)
            for (std::uint32_t j = 0; j < leaf_b.count(); ++j)
                best_sq = std::min(best_sq, triangle_triangle_distance(
                                                s_.placed_a[s_.a.tree.order[leaf_a.first() + i]],
                                                s_.placed_b[s_.b.tree.order[leaf_b.first() + j]])
                                                .distance_sq);
        return stop_ ? -1 : best_sq;
    }
    double best_sq = HUGE_VAL;
    int visits = 0;

private:
    const Scene& s_;
    bool stop_;
};

TEST(TraverseVolumes, FindsTheNearestPair) {
    Random random(1302);
    std::array<int, kKinds.size()> visits{};
    for (int round = 0; round < 40; ++round) {
        Scene s(random, {"rigid", 10, 1, 0, false}, 120);
        Scene::put(s.world_b, s.offset_b, apply(s.world_a, s.offset_a) + 4 * random.direction());
        s.placed_b = s.b.placed(s.world_b);
        double expected = HUGE_VAL;
        for (const Triangle& t : s.placed_a)
            for (const Triangle& u : s.placed_b)
                expected = std::min(expected, triangle_triangle_distance(t, u).distance_sq);
        for (std::size_t k = 0; k < kKinds.size(); ++k) {
            const auto va = s.a.volumes(kKinds[k]), vb = s.b.volumes(kKinds[k]);
            const VolumeFrame frame = make_volume_frame(*va, s.world_a, *vb, s.world_b);
            VolumeTraversal t{s.a.tree, *va, s.b.tree, *vb, frame, HUGE_VAL};
            Nearest nearest(s, false);
            EXPECT_EQ(traverse_best_first(t, nearest), Verdict::done);
            ASSERT_EQ(nearest.best_sq, expected);
            visits[k] += nearest.visits;
            EXPECT_GT(t.volume_tests, 0U);

            Nearest first(s, true);
            VolumeTraversal stopped{s.a.tree, *va, s.b.tree, *vb, frame, HUGE_VAL};
            EXPECT_EQ(traverse_depth_first(stopped, first), Verdict::stopped);
            EXPECT_EQ(first.visits, 1);
        }
    }
    for (const int count : visits) {
        std::cout << count << " leaf pairs\n";
        EXPECT_LT(count, 40 * 40 * 40 / 10);
    }
}

TEST(TraverseVolumes, AcceptsEarlyOnlyWhatIsWithinTheBound) {
    Random random(1303);
    int accepted = 0, done = 0;
    for (int round = 0; round < 60; ++round) {
        Scene s(random, {"any", 10, 1, 0, round % 2 == 0}, 60);
        Scene::put(s.world_b, s.offset_b,
                   apply(s.world_a, s.offset_a) + random.uniform(0, 6) * random.direction());
        s.placed_b = s.b.placed(s.world_b);
        double distance_sq = HUGE_VAL;
        for (const Triangle& t : s.placed_a)
            for (const Triangle& u : s.placed_b)
                distance_sq = std::min(distance_sq, triangle_triangle_distance(t, u).distance_sq);
        const double bound_sq = distance_sq * std::pow(random.uniform(0.5, 12), 2);
        for (const Volume volume : kKinds) {
            const auto va = s.a.volumes(volume), vb = s.b.volumes(volume);
            const VolumeFrame frame = make_volume_frame(*va, s.world_a, *vb, s.world_b);
            VolumeTraversal t{s.a.tree, *va, s.b.tree, *vb, frame, bound_sq};
            t.accept_early = true;
            Recorder recorder(s.a.tree, s.b.tree, bound_sq);
            const Verdict verdict = traverse_depth_first(t, recorder);
            if (verdict == Verdict::accepted) {
                ++accepted;
                ASSERT_LE(distance_sq, bound_sq);
            } else {
                ASSERT_EQ(verdict, Verdict::done);
                ++done;
            }
        }
    }
    std::cout << accepted << " accepted, " << done << " done\n";
    EXPECT_GT(accepted, 40);
    EXPECT_GT(done, 40);
}

TEST(TraverseVolumes, WhatHasNoVolumes) {
    Random random(1304);
    const Primitives a(random, 20, {}, 1);
    EXPECT_EQ(a.volumes(Volume::aabb), nullptr);
    EXPECT_EQ(a.volumes(Volume::automatic), nullptr);
    EXPECT_EQ(build_volume_tree(Volume::obb, Tree(), {}, 0), nullptr);
    const auto obb = a.volumes(Volume::obb), rss = a.volumes(Volume::rss);
    EXPECT_EQ(obb->kind(), Volume::obb);
    EXPECT_EQ(obb->bytes(), a.tree.nodes.size() * 15 * 8 * sizeof(float));
    EXPECT_FALSE(make_volume_frame(*obb, {}, *rss, {}).valid);
    const Transform flat({1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_FALSE(make_volume_frame(*obb, {}, *obb, flat).valid);
    EXPECT_TRUE(make_volume_frame(*obb, {}, *obb, {}).valid);
}

TEST(TraverseVolumes, OneTriangleEach) {
    Random random(1305);
    int near = 0;
    for (int i = 0; i < 300; ++i) {
        const Primitives a(random, 1, {}, 1), b(random, 1, {}, 1);
        const Transform world = random.pose(1);
        const Triangle &s = a.triangles[0], t = b.placed(world)[0];
        const double distance_sq = triangle_triangle_distance(s, t).distance_sq;
        for (const Volume volume : kKinds) {
            const auto va = a.volumes(volume), vb = b.volumes(volume);
            const VolumeFrame frame = make_volume_frame(*va, {}, *vb, world);
            VolumeTraversal traversal{a.tree, *va, b.tree, *vb, frame, 1};
            Recorder recorder(a.tree, b.tree, 1);
            EXPECT_EQ(traverse_depth_first(traversal, recorder), Verdict::done);
            if (distance_sq <= 1) {
                ++near;
                ASSERT_EQ(recorder.seen.size(), 1U);
            }
        }
    }
    EXPECT_GT(near, 300);
}

} // namespace
} // namespace abut::test
