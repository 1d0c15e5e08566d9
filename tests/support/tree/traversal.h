#pragma once

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "tests/support/random.h"
#include "tree/traverse_pair.h"

#include <array>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <utility>
#include <vector>

/// Two sets of triangles, and the pairs that a traversal of their trees must visit.
namespace abut::test {

/// Triangles with a tree in their own frame. Some degenerate to segments.
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
    [[nodiscard]] std::vector<Triangle> placed(const Transform& world) const {
        std::vector<Triangle> result = triangles;
        for (Triangle& t : result)
            for (Vec3& p : t)
                p = apply(world, p);
        return result;
    }
};

struct SceneKind {
    const char* name;
    double reach;        ///< of the translations
    double size;         ///< of both models
    double model_offset; ///< distance of the models from their own origins
    bool affine;
};

constexpr std::array kSceneKinds{SceneKind{"rigid", 10, 1, 0, false},
                                 SceneKind{"affine", 10, 1, 0, true},
                                 SceneKind{"far_in_the_world", 1e5, 1, 0, false},
                                 SceneKind{"far_affine", 1e5, 1, 0, true},
                                 SceneKind{"far_in_the_model", 10, 1, 1e3, false},
                                 SceneKind{"tiny", 0, 1e-6, 0, true},
                                 SceneKind{"huge", 1e6, 1e6, 0, true}};

/// Two sets of triangles close together in the world.
struct TreeScene {
    Vec3 offset_a, offset_b;
    Primitives a, b;
    Transform world_a, world_b;
    std::vector<Triangle> placed_a, placed_b;

    TreeScene(Random& random, const SceneKind& kind, int count)
        : offset_a(random.in_cube(kind.model_offset)), offset_b(random.in_cube(kind.model_offset)),
          a(random, count, offset_a, kind.size), b(random, count, offset_b, kind.size),
          world_a(random.linear_map(kind.affine)), world_b(random.linear_map(kind.affine)) {
        const Vec3 place = random.in_cube(kind.reach);
        put(world_a, offset_a, place);
        placed_a = a.placed(world_a);
        put_b(place + random.in_cube(0.5 * kind.size));
    }
    /// Moves b's centre to a point of the world.
    void put_b(const Vec3& at) {
        put(world_b, offset_b, at);
        placed_b = b.placed(world_b);
    }

private:
    static void put(Transform& t, const Vec3& middle, const Vec3& at) {
        const Vec3 shift = at - apply_linear(t, middle);
        t.m[9] = shift.x, t.m[10] = shift.y, t.m[11] = shift.z;
    }
};

/// Calls body(i, j) with the primitives of each pair in a set of LeafPairs.
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

using IndexPair = std::pair<std::uint32_t, std::uint32_t>;

/// Records what is visited. The bound stays the same.
class Recorder : public LeafPairVisitor {
public:
    Recorder(const Tree& a, const Tree& b, double bound_sq, const Vec3& direction = {})
        : a_(a), b_(b), bound_sq_(bound_sq), direction_(direction) {}
    double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& pairs) override {
        EXPECT_NE(pairs.any(), 0U);
        EXPECT_EQ(pairs.cross & pairs.may_meet, 0U);
        const auto add_to = [](std::set<IndexPair>& set) {
            return [&set](std::uint32_t i, std::uint32_t j) { set.emplace(i, j); };
        };
        for_each_primitive_pair(a_, leaf_a, b_, leaf_b, pairs.any(), add_to(seen));
        for_each_primitive_pair(a_, leaf_a, b_, leaf_b, pairs.cross, add_to(cross));
        return bound_sq_;
    }
    [[nodiscard]] Vec3 direction() const override { return direction_; }
    std::set<IndexPair> seen, cross;

private:
    const Tree& a_;
    const Tree& b_;
    double bound_sq_;
    Vec3 direction_;
};

/// The true answers for all pairs of triangles of a scene: which share a point, and which are
/// within a bound.
struct PairTruth {
    std::map<IndexPair, TriangleContact> contacts;
    std::array<double, 4> bounds;
    std::array<std::set<IndexPair>, 4> within;

    PairTruth(const TreeScene& s, double size) : bounds{0, 0.01 * size, 0.2 * size, 10 * size} {
        for (std::uint32_t i = 0; i < s.placed_a.size(); ++i)
            for (std::uint32_t j = 0; j < s.placed_b.size(); ++j) {
                const Triangle &t = s.placed_a[i], &u = s.placed_b[j];
                if (const auto kind = triangle_triangle_intersect(t, u);
                    kind != TriangleContact::none)
                    contacts[{i, j}] = kind;
                const double distance_sq = triangle_triangle_distance(t, u).distance_sq;
                for (std::size_t k = 0; k < bounds.size(); ++k)
                    if (distance_sq <= bounds[k] * bounds[k])
                        within[k].emplace(i, j);
            }
    }
};

/// Counts of what traversals found, to check that a test is not vacuous.
struct Tally {
    std::size_t met = 0, crossed = 0; ///< pairs that share a point; pairs reported as crossing
    std::size_t accepted = 0;
    std::size_t within = 0, visited = 0, total = 0; ///< numbers of pairs, for bounds that not all
                                                    ///< pairs are within
};

/// Expects that every pair that touches or is within a bound is visited, and that only pairs that
/// do cross are reported as crossing.
///
/// In          traversal: `pair`, or one that refers to it.
template <typename Traversal>
void expect_no_pair_lost(const TreeScene& s, const PairTruth& truth, const Vec3& direction,
                         PairTraversal& pair, Traversal& traversal, Tally& tally) {
    pair.bound_sq = 0;
    Recorder touched(s.a.tree, s.b.tree, 0);
    EXPECT_EQ(traverse_contacts(traversal, touched), Verdict::done);
    for (const auto& [triangles, how] : truth.contacts)
        ASSERT_TRUE(touched.seen.contains(triangles));
    for (const IndexPair& triangles : touched.cross) {
        ASSERT_TRUE(truth.contacts.contains(triangles));
        ASSERT_EQ(truth.contacts.at(triangles), TriangleContact::cross);
    }
    tally.met += truth.contacts.size(), tally.crossed += touched.cross.size();
    for (std::size_t i = 0; i < truth.bounds.size(); ++i) {
        SCOPED_TRACE(testing::Message() << "bound " << truth.bounds[i]);
        const double bound_sq = truth.bounds[i] * truth.bounds[i];
        pair.bound_sq = bound_sq;
        Recorder in_depth(s.a.tree, s.b.tree, bound_sq),
            nearest_first(s.a.tree, s.b.tree, bound_sq),
            directed(s.a.tree, s.b.tree, bound_sq, direction);
        const Verdict verdict = traverse_within(traversal, in_depth);
        EXPECT_EQ(traverse_nearest(traversal, nearest_first), Verdict::done);
        EXPECT_EQ(traverse_nearest(traversal, directed), Verdict::done);
        for (const IndexPair& triangles : truth.within[i]) {
            ASSERT_TRUE(verdict == Verdict::accepted || in_depth.seen.contains(triangles));
            ASSERT_TRUE(nearest_first.seen.contains(triangles));
            ASSERT_TRUE(directed.seen.contains(triangles));
        }
        if (verdict == Verdict::accepted) {
            ++tally.accepted;
            ASSERT_FALSE(truth.within[i].empty());
        }
        const std::size_t all = s.placed_a.size() * s.placed_b.size();
        if (truth.within[i].size() == all)
            continue;
        tally.within += truth.within[i].size();
        tally.visited += nearest_first.seen.size();
        tally.total += all;
    }
}

} // namespace abut::test
