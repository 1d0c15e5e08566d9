// Pairs of leaves until a time, against all pairs of leaves at many times.

#include "deform/deformable_data.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"
#include "tree/traverse_until.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iostream>
#include <map>
#include <set>

namespace abut::test {
namespace {

using PairSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

struct Collector final : UntilVisitor {
    float time;
    bool is_self;
    PairSet pairs;

    Collector(float until, bool self) : time(until), is_self(self) {}
    [[nodiscard]] float until() const override { return time; }
    bool visit(std::uint32_t a, std::uint32_t b) override {
        const bool is_new =
            pairs.insert(is_self ? std::pair(std::min(a, b), std::max(a, b)) : std::pair(a, b))
                .second;
        EXPECT_TRUE(is_new) << a << ' ' << b;
        return true;
    }
};

std::map<std::uint32_t, MovingBox> leaf_boxes(const MovingTree& tree) {
    std::map<std::uint32_t, MovingBox> boxes;
    for (const MovingNode& node : tree.nodes)
        for (std::size_t i = 0; i < MovingNode::kWidth; ++i)
            if (!node.child[i].is_none() && node.child[i].is_leaf())
                boxes[leaf_number(node.child[i])] = moving_tree::box_of(node, i);
    return boxes;
}

/// Whether two boxes are within the margin at a time.
bool near_at(const MovingBox& a, const MovingBox& b, double margin, double t) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto gap = [&](const MovingBox& low, const MovingBox& high) {
            return (1 - t) * (double{high.start.lower[i]} - double{low.start.upper[i]}) +
                   t * (double{high.end.lower[i]} - double{low.end.upper[i]});
        };
        if (gap(a, b) > margin || gap(b, a) > margin)
            return false;
    }
    return true;
}

TEST(TraverseUntil, VisitsEveryPairOfLeavesOnce) {
    for_each_simd_target([&](const std::string& name) {
        Random random(29);
        std::size_t visited = 0, at_start = 0, deferred = 0;
        for (int round = 0; round < many(30); ++round) {
            const Deformable a = crumpled_sheet(random, random.integer(2, 12)).deformable(),
                             b = crumpled_sheet(random, random.integer(2, 12)).deformable();
            const bool self = round % 2 == 0;
            const auto margin = float(round % 3 == 0 ? random.uniform(0, 0.1) : 0.0);
            const OverlapTraversal traversal{
                a.data().swept.tree, self ? a.data().swept.tree : b.data().swept.tree, margin};
            Collector collector(float(random.uniform(0, 1)), self);
            std::vector<TimedPair> later;
            std::vector<TimedPair>* const defers = round % 5 == 4 ? nullptr : &later;
            traverse_until(traversal, {}, collector, defers);
            at_start += collector.pairs.size();
            deferred += later.size();
            for (const TimedPair& pair : later) {
                ASSERT_GE(pair.first, 0);
                traverse_until(traversal, pair, collector, nullptr);
            }
            visited += collector.pairs.size();
            const auto boxes_a = leaf_boxes(traversal.a), boxes_b = leaf_boxes(traversal.b);
            for (const auto& [i, box_i] : boxes_a)
                for (const auto& [k, box_k] : boxes_b)
                    for (int step = 0; step <= 20 && (!self || i <= k); ++step)
                        if (near_at(box_i, box_k, margin, double{collector.time} * step / 20)) {
                            ASSERT_TRUE(collector.pairs.count({i, k}) == 1)
                                << name << ": " << i << ' ' << k;
                        }
        }
        std::cout << name << ": " << visited << " pairs, " << at_start << " at the start, "
                  << deferred << " deferred\n";
        EXPECT_GT(visited, at_start);
        EXPECT_GT(deferred, std::size_t(many(30)));
    });
}

} // namespace
} // namespace abut::test
