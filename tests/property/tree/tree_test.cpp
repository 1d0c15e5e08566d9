#include <abut/progress.h>

#include "math/transform.h"
#include "tests/support/random.h"
#include "tree/obb_tree.h"
#include "tree/traverse_one.h"

#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <stdexcept>

namespace abut::test {
namespace {

using Boxes = std::vector<Aabb>;

Boxes boxes_of(int count, const std::function<Box3(int)>& make) {
    Boxes boxes;
    for (int i = 0; i < count; ++i)
        boxes.emplace_back(make(i));
    return boxes;
}
Box3 box_at(const Vec3& p, const Vec3& size) {
    Box3 box;
    extend(box, p);
    extend(box, p + size);
    return box;
}
Boxes random_boxes(Random& random, int count, double half = 100, double size = 1) {
    return boxes_of(count, [&](int) { return box_at(random.in_cube(half), random.in_cube(size)); });
}

void expect_same(const Tree& a, const Tree& b) {
    EXPECT_EQ(a.order, b.order);
}

void expect_valid(const Boxes& boxes) {
    const Tree tree = build_tree(boxes);
    ASSERT_NO_THROW(validate(tree, boxes)) << boxes.size() << " boxes";
    // Almost all leaves and nodes are full.
    EXPECT_LE(tree.order.size(), 4 + 1.3 * static_cast<double>(boxes.size()));
    EXPECT_LE(tree.nodes.size(), 1 + boxes.size() / 12);
}

TEST(Tree, TreesOfEverySizeAreValid) {
    Random random(801);
    for (const int count : {0, 1, 2, 3, 4, 5, 8, 9, 33, 1000, 100000})
        expect_valid(random_boxes(random, count));
}

TEST(Tree, TreesOfSpecialBoxesAreValid) {
    expect_valid(boxes_of(1000, [](int) { return Box3{{1, 2, 3}, {4, 5, 6}}; }));
    expect_valid(boxes_of(1000, [](int) { return Box3{{1, 1, 1}, {1, 1, 1}}; }));
    expect_valid(boxes_of(1000, [](int i) { return box_at({double(i), 0, 0}, {}); })); // on a line
    expect_valid(boxes_of(1000, [](int i) { return box_at({double(i * i), 0, 0}, {}); }));
    expect_valid(boxes_of(300, [](int i) { return box_at({std::pow(2.0, i % 120), 0, 0}, {}); }));
    Random random(802);
    expect_valid(random_boxes(random, 1000, 1e18, 1e18));
    expect_valid(random_boxes(random, 1000, 1e-40, 1e-42)); // subnormal floats
    expect_valid(random_boxes(random, 1000, 0x1p-149, 0x1p-149));
    expect_valid(random_boxes(random, 1000, 1e5, 1e-9)); // boxes that are flat after rounding
}

TEST(Tree, ValidateFindsFaults) {
    Random random(803);
    const Boxes boxes = random_boxes(random, 200);
    const Tree good = build_tree(boxes);
    Tree bad = good;
    std::uint32_t other = 0;
    while (bad.order[other] == bad.order[7])
        ++other;
    bad.order[7] = bad.order[other];
    EXPECT_THROW(validate(bad, boxes), std::logic_error);
    Boxes grown = boxes;
    grown[good.order[50]].upper[1] += 100;
    EXPECT_THROW(validate(good, grown), std::logic_error);
    EXPECT_THROW(validate(good, random_boxes(random, 199)), std::logic_error);
    bad = good;
    bad.nodes[0].child[0] = bad.nodes[0].child[1];
    EXPECT_THROW(validate(bad, boxes), std::logic_error);
}

TEST(Tree, TheSameForAnyNumberOfThreads) {
    Random random(804);
    const Boxes boxes = random_boxes(random, 60000);
    set_threads(1);
    const Tree one = build_tree(boxes);
    set_threads(2);
    const Tree two = build_tree(boxes);
    set_threads(0);
    expect_same(one, two);
    // A traversal gives the same slots in the same order; only node numbers may differ.
    const auto visits = [](const Tree& tree) {
        std::vector<std::uint32_t> slots;
        for_each_overlap(tree, Aabb(Box3{{-30, -30, -30}, {30, 30, 30}}),
                         [&](std::uint32_t slot) { slots.push_back(slot); });
        return slots;
    };
    EXPECT_EQ(visits(one), visits(two));
    EXPECT_FALSE(visits(one).empty());
}

/// A set of triangles to build a tree of.
struct Soup {
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    void add(const Triangle& t) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), t.begin(), t.end());
        triangles.push_back({first, first + 1, first + 2});
    }
    [[nodiscard]] TreeMesh mesh() const { return {positions, triangles}; }
};

TEST(Tree, EnclosesItsTrianglesInEveryNodesFrame) {
    Random random(810);
    std::size_t turned = 0, nodes = 0;
    for (int kind = 0; kind < 60; ++kind) {
        const double scale = std::pow(10, random.integer(-6, 6));
        const Vec3 away = random.in_cube(kind % 5 == 0 ? 1000 * scale : 0);
        const Transform pose = random.pose(0);
        Soup soup;
        const int count = kind < 10 ? kind : random.integer(1, 5000);
        for (int i = 0; i < count; ++i) {
            Vec3 p = random.in_cube(scale);
            if (kind % 3 == 0)
                p.z = 0.1 * p.x; // an oblique plane
            Triangle t{p, p + random.in_cube(0.05 * scale), p + random.in_cube(0.05 * scale)};
            if (i % 20 == 0)
                t[1] = t[2]; // zero area
            for (Vec3& v : t)
                v = away + apply(pose, v);
            soup.add(t);
        }
        const Tree tree = build_tree(soup.mesh());
        ASSERT_NO_THROW(validate(tree, soup.mesh())) << "kind " << kind;
        for (const Node& node : tree.nodes) {
            ++nodes;
            turned += node.frame.turn[0][0] != 1 ? 1 : 0;
        }
    }
    EXPECT_GT(turned, nodes / 10);
    EXPECT_LT(turned, nodes);
}

TEST(Tree, LeavesHoldTheirTrianglesInTheirNodesFrame) {
    Random random(811);
    Soup soup;
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p = random.in_cube(1);
        soup.add({p, p + random.in_cube(0.01), p + random.in_cube(0.01)});
    }
    const Tree tree = build_tree(soup.mesh());
    std::size_t seen = 0;
    for (const Node& node : tree.nodes)
        for (const NodeRef child : node.child) {
            if (child.is_none() || !child.is_leaf())
                continue;
            for (std::uint32_t lane = 0; lane < child.count(); ++lane)
                for (std::size_t v = 0; v < 3; ++v) {
                    const auto& leaf = tree.leaf(child);
                    const Vec3 p = node.frame.point_from_tree(
                        soup.positions[soup.triangles[tree.order[child.first() + lane]][v]]);
                    ASSERT_EQ(leaf.v[v][0][lane], static_cast<float>(p.x));
                    ASSERT_EQ(leaf.v[v][1][lane], static_cast<float>(p.y));
                    ASSERT_EQ(leaf.v[v][2][lane], static_cast<float>(p.z));
                    ++seen;
                }
        }
    EXPECT_EQ(seen, 9000U);
}

bool meet(const Aabb& a, const Aabb& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.lower[k] > b.upper[k] || b.lower[k] > a.upper[k])
            return false;
    return true;
}

TEST(TraverseOne, OverlapVisitsEveryBoxThatMeetsTheQuery) {
    Random random(805);
    std::size_t met = 0, visited = 0;
    for (int i = 0; i < 60; ++i) {
        const Boxes boxes = random_boxes(random, random.integer(1, 3000), 10, 1);
        const Tree tree = build_tree(boxes);
        for (int k = 0; k < 20; ++k) {
            const Aabb query(box_at(random.in_cube(12), random.in_cube(random.uniform(0, 8))));
            std::set<std::uint32_t> seen;
            for_each_overlap(tree, query, [&](std::uint32_t slot) {
                ASSERT_TRUE(seen.insert(tree.order[slot]).second);
            });
            for (std::uint32_t j = 0; j < boxes.size(); ++j)
                if (meet(boxes[j], query)) {
                    ++met;
                    ASSERT_TRUE(seen.contains(j));
                }
            visited += seen.size();
        }
    }
    EXPECT_GT(met, 1500U);
    EXPECT_LT(visited, 16 * met); // whole leaves are visited, but not the whole tree
}

/// Whether a segment meets a box, by clipping to slabs in double precision.
bool segment_meets(const Aabb& box, const Vec3& p, const Vec3& q) {
    double enter = 0, leave = 1;
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double low = double{box.lower[i]} - component(p, k),
                     high = double{box.upper[i]} - component(p, k);
        const double d = component(q, k) - component(p, k);
        if (d == 0) {
            if (low > 0 || high < 0)
                return false;
            continue;
        }
        enter = std::max(enter, std::min(low / d, high / d));
        leave = std::min(leave, std::max(low / d, high / d));
    }
    return enter <= leave;
}

TEST(TraverseOne, SegmentVisitsEveryBoxOnIt) {
    Random random(806);
    std::size_t met = 0, visited = 0, total = 0;
    for (int i = 0; i < 40; ++i) {
        const double scale = std::pow(10, random.integer(-4, 4));
        const Boxes boxes = random_boxes(random, random.integer(1, 2000), 10 * scale, scale);
        const Tree tree = build_tree(boxes);
        for (int k = 0; k < 20; ++k) {
            Vec3 p = random.in_cube(12 * scale), q = random.in_cube(12 * scale);
            if (k % 4 == 0)
                q.x = p.x;
            if (k % 8 == 0)
                q.y = p.y;
            const auto to_float = [](const Vec3& v) {
                return std::array{static_cast<float>(v.x), static_cast<float>(v.y),
                                  static_cast<float>(v.z)};
            };
            const TreeSegment segment{to_float(0.5 * (p + q)), to_float(0.5 * (q - p)),
                                      static_cast<float>(32 * 0x1p-24 * 4 * 11 * scale)};
            std::set<std::uint32_t> seen;
            for_each_on_segment(tree, segment,
                                [&](std::uint32_t slot) { seen.insert(tree.order[slot]); });
            for (std::uint32_t j = 0; j < boxes.size(); ++j)
                if (segment_meets(boxes[j], p, q)) {
                    ++met;
                    ASSERT_TRUE(seen.contains(j));
                }
            visited += seen.size();
            total += boxes.size();
        }
    }
    EXPECT_GT(met, 300U);
    EXPECT_LT(visited, total / 10);
}

TEST(TraverseOne, NearFindsTheNearestBox) {
    Random random(807);
    std::size_t visited = 0, total = 0;
    for (int i = 0; i < 300; ++i) {
        const Boxes boxes = random_boxes(random, random.integer(1, 2000), 10, 0.3);
        const Tree tree = build_tree(boxes);
        const Vec3 p = random.in_cube(14);
        const std::array<float, 3> point{static_cast<float>(p.x), static_cast<float>(p.y),
                                         static_cast<float>(p.z)};
        const auto distance_sq_to = [&](const Aabb& box) {
            float sum = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const float gap =
                    std::max({0.0F, box.lower[k] - point[k], point[k] - box.upper[k]});
                sum += gap * gap;
            }
            return sum;
        };
        float expected = HUGE_VALF, best = HUGE_VALF;
        for (const Aabb& box : boxes)
            expected = std::min(expected, distance_sq_to(box));
        for_each_near(tree, point, 0, HUGE_VALF, [&](std::uint32_t slot) {
            ++visited;
            best = std::min(best, distance_sq_to(boxes[tree.order[slot]]));
            return best;
        });
        total += boxes.size();
        ASSERT_EQ(best, expected);
        // With a bound below the nearest box, no primitive may be visited.
        std::size_t none = 0;
        if (expected > 0)
            for_each_near(tree, point, 0, expected * 0.25F, [&](std::uint32_t slot) {
                none += distance_sq_to(boxes[tree.order[slot]]) <= expected * 0.25F ? 1 : 0;
                return expected * 0.25F;
            });
        ASSERT_EQ(none, 0U);
    }
    EXPECT_LT(visited, total / 10);
}

TEST(TraverseOne, AnEmptyTreeHasNothing) {
    const Tree tree = build_tree(std::span<const Aabb>());
    EXPECT_TRUE(tree.empty());
    const auto fail = [](std::uint32_t) -> float {
        ADD_FAILURE();
        return 0;
    };
    for_each_overlap(tree, Aabb(Box3{{-1, -1, -1}, {1, 1, 1}}), fail);
    for_each_on_segment(tree, {{0, 0, 0}, {1, 1, 1}, 1}, fail);
    for_each_near(tree, {0, 0, 0}, 0, HUGE_VALF, fail);
}

} // namespace
} // namespace abut::test
