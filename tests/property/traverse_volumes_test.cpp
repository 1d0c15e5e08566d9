// A traversal of two trees by volumes of every kind against all pairs of triangles: none within the
// bound may be lost.

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "tests/support/random.h"
#include "tests/support/simd_targets.h"
#include "tree/traverse_volumes.h"

#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace abut::test {
namespace {

constexpr std::array kKinds{Volume::sphere, Volume::kdop14, Volume::kdop18, Volume::kdop26,
                            Volume::obb,    Volume::pss,    Volume::lss,    Volume::rss};

/// Triangles with a tree in their own frame.
struct Primitives {
    std::vector<Triangle> triangles;
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> indices;
    Tree tree;

    Primitives(Random& random, int count, const Vec3& middle, double scale) {
        for (int i = 0; i < count; ++i) {
            const Vec3 p = middle + random.in_cube(scale);
            const double size = scale * std::pow(10, random.uniform(-2.5, 0));
            triangles.push_back({p, p + random.in_cube(size), p + random.in_cube(size)});
            if (i % 10 == 0)
                triangles.back()[2] = triangles.back()[i % 20 == 0 ? 0 : 1];
            const auto first = static_cast<std::uint32_t>(positions.size());
            positions.insert(positions.end(), triangles.back().begin(), triangles.back().end());
            indices.push_back({first, first + 1, first + 2});
        }
        tree = build_tree(mesh());
    }
    [[nodiscard]] TreeMesh mesh() const { return {positions, indices}; }
    [[nodiscard]] std::unique_ptr<const VolumeTree> volumes(Volume kind) const {
        return build_volume_tree(kind, tree, mesh());
    }
    [[nodiscard]] std::vector<Triangle> placed(const Transform& world) const {
        std::vector<Triangle> result = triangles;
        for (Triangle& t : result)
            for (Vec3& p : t)
                p = apply(world, p);
        return result;
    }
};

/// Calls body(i, j) with the primitives of each pair of a set of LeafPairs.
template <typename Body>
void for_each_primitive_pair(const Tree& a, NodeRef leaf_a, const Tree& b, NodeRef leaf_b,
                             std::uint32_t pairs, const Body& body) {
    for (std::uint32_t i = 0; i < TriangleLeaf::kLanes; ++i)
        for (std::uint32_t j = 0; j < TriangleLeaf::kLanes; ++j)
            if ((pairs >> (TriangleLeaf::kLanes * i + j) & 1U) != 0) {
                ASSERT_LT(i, leaf_a.count());
                ASSERT_LT(j, leaf_b.count());
                body(a.order[leaf_a.first() + i], b.order[leaf_b.first() + j]);
            }
}

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

class Recorder : public LeafPairVisitor {
public:
    Recorder(const Tree& a, const Tree& b, double bound_sq) : a_(a), b_(b), bound_sq_(bound_sq) {}
    double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& pairs) override {
        EXPECT_NE(pairs.any(), 0U);
        const auto add_to = [](Pairs& set) {
            return [&set](std::uint32_t i, std::uint32_t j) { set.emplace(i, j); };
        };
        for_each_primitive_pair(a_, leaf_a, b_, leaf_b, pairs.any(), add_to(seen));
        for_each_primitive_pair(a_, leaf_a, b_, leaf_b, pairs.cross, add_to(cross));
        return bound_sq_;
    }
    Pairs seen, cross;

private:
    const Tree& a_;
    const Tree& b_;
    double bound_sq_;
};

Box3 box_of(const Triangle& t) {
    Box3 box;
    for (const Vec3& p : t)
        extend(box, p);
    return box;
}

/// Pairs that share a point, and how.
std::map<std::pair<std::uint32_t, std::uint32_t>, TriangleContact>
contacts_of(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, TriangleContact> contacts;
    for (std::uint32_t i = 0; i < a.size(); ++i)
        for (std::uint32_t j = 0; j < b.size(); ++j)
            if (overlap(box_of(a[i]), box_of(b[j])))
                if (const auto kind = triangle_triangle_intersect(a[i], b[j]);
                    kind != TriangleContact::none)
                    contacts[{i, j}] = kind;
    return contacts;
}

/// Pairs whose distance is at most the bound.
Pairs near_pairs_of(const std::vector<Triangle>& a, const std::vector<Triangle>& b, double bound) {
    Pairs pairs;
    for (std::uint32_t i = 0; i < a.size(); ++i)
        for (std::uint32_t j = 0; j < b.size(); ++j)
            if (overlap(box_of(a[i]), box_of(b[j]), bound) &&
                triangle_triangle_distance(a[i], b[j]).distance_sq <= bound * bound)
                pairs.emplace(i, j);
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

/// All that a traversal of a scene by one kind of volume refers to.
struct Placed {
    std::unique_ptr<const VolumeTree> a, b;
    PairFrame boxes;
    VolumeFrame volumes;

    Placed(const Scene& s, Volume kind)
        : a(s.a.volumes(kind)), b(s.b.volumes(kind)),
          boxes(make_pair_frame(s.a.tree, s.world_a, s.b.tree, s.world_b)),
          volumes(make_volume_frame(*a, s.world_a, *b, s.world_b)) {}
};

class TraverseVolumes : public testing::TestWithParam<Kind> {};

TEST_P(TraverseVolumes, VisitsEveryPairWithinTheBound) {
    const Kind& kind = GetParam();
    Random random(1301);
    std::size_t met = 0, crossed = 0, within = 0, accepted = 0, visited = 0, total = 0;
    for (int round = 0; round < 4; ++round) {
        const Scene s(random, kind, 100);
        const auto contacts = contacts_of(s.placed_a, s.placed_b);
        const std::array bounds{0.0, 0.01 * kind.size, 0.2 * kind.size, 10 * kind.size};
        std::array<Pairs, bounds.size()> truth;
        for (std::size_t i = 0; i < bounds.size(); ++i)
            truth[i] = near_pairs_of(s.placed_a, s.placed_b, bounds[i]);
        for (const Volume volume : kKinds) {
            const Placed placed(s, volume);
            ASSERT_TRUE(placed.volumes.valid);
            for_each_simd_target([&](const std::string& target) {
                SCOPED_TRACE(testing::Message() << "volume " << int(volume) << ' ' << target);
                PairTraversal pair{s.a.tree, s.b.tree, placed.boxes};
                const VolumeTraversal t{pair, *placed.a, *placed.b, placed.volumes};
                Recorder touched(s.a.tree, s.b.tree, 0);
                EXPECT_EQ(traverse_contacts(t, touched), Verdict::done);
                for (const auto& [triangles, how] : contacts)
                    ASSERT_TRUE(touched.seen.contains(triangles));
                for (const auto& triangles : touched.cross) {
                    ASSERT_TRUE(contacts.contains(triangles));
                    ASSERT_EQ(contacts.at(triangles), TriangleContact::cross);
                }
                met += contacts.size(), crossed += touched.cross.size();
                for (std::size_t i = 0; i < bounds.size(); ++i) {
                    const double bound_sq = bounds[i] * bounds[i];
                    Recorder in_depth(s.a.tree, s.b.tree, bound_sq),
                        nearest_first(s.a.tree, s.b.tree, bound_sq);
                    pair.bound_sq = bound_sq;
                    const Verdict verdict = traverse_within(t, in_depth);
                    EXPECT_EQ(traverse_nearest(t, nearest_first), Verdict::done);
                    for (const auto& triangles : truth[i]) {
                        ASSERT_TRUE(nearest_first.seen.contains(triangles));
                        ASSERT_TRUE(verdict != Verdict::done || in_depth.seen.contains(triangles));
                    }
                    if (verdict == Verdict::accepted) {
                        ++accepted;
                        ASSERT_FALSE(truth[i].empty());
                    }
                    if (bounds[i] > kind.size) // all pairs
                        continue;
                    EXPECT_EQ(traverse_nearest(t, nearest_first), Verdict::done);
                    for (const auto& triangles : truth[i])
                        ASSERT_TRUE(nearest_first.seen.contains(triangles));
                    within += truth[i].size();
                    visited += nearest_first.seen.size();
                    total += s.a.triangles.size() * s.b.triangles.size();
                }
            });
        }
    }
    EXPECT_GT(met, 300U);
    EXPECT_GT(crossed, met / 2);
    EXPECT_GT(accepted, 0U);
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
    double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& pairs) override {
        ++visits;
        for_each_primitive_pair(
            s_.a.tree, leaf_a, s_.b.tree, leaf_b, pairs.any(),
            [&](std::uint32_t i, std::uint32_t j) {
                best_sq = std::min(
                    best_sq,
                    triangle_triangle_distance(s_.placed_a[i], s_.placed_b[j]).distance_sq);
            });
        return stop_ ? -1 : best_sq;
    }
    double best_sq = HUGE_VAL;
    int visits = 0;

private:
    const Scene& s_;
    bool stop_;
};

double distance_sq_of(const Scene& s) {
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
        Scene s(random, {"rigid", 10, 1, 0, false}, 120);
        Scene::put(s.world_b, s.offset_b, apply(s.world_a, s.offset_a) + 4 * random.direction());
        s.placed_b = s.b.placed(s.world_b);
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

TEST(TraverseVolumes, AcceptsOnlyWhatIsWithinTheBound) {
    Random random(1303);
    int accepted = 0, done = 0;
    for (int round = 0; round < 60; ++round) {
        Scene s(random, {"any", 10, 1, 0, round % 2 == 0}, 60);
        Scene::put(s.world_b, s.offset_b,
                   apply(s.world_a, s.offset_a) + random.uniform(0, 6) * random.direction());
        s.placed_b = s.b.placed(s.world_b);
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

TEST(TraverseVolumes, WhatHasNoVolumes) {
    Random random(1304);
    const Primitives a(random, 20, {}, 1);
    EXPECT_EQ(a.volumes(Volume::aabb), nullptr);
    EXPECT_EQ(a.volumes(Volume::automatic), nullptr);
    EXPECT_EQ(build_volume_tree(Volume::obb, Tree(), {}), nullptr);
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
    int near = 0, far = 0;
    for (int i = 0; i < 300; ++i) {
        const Primitives a(random, 1, {}, 1), b(random, 1, {}, 1);
        const Transform world = random.pose(1);
        const double distance_sq =
            triangle_triangle_distance(a.triangles[0], b.placed(world)[0]).distance_sq;
        const PairFrame boxes = make_pair_frame(a.tree, {}, b.tree, world);
        for (const Volume volume : kKinds) {
            const auto va = a.volumes(volume), vb = b.volumes(volume);
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
