// A hierarchy made from its outline equals the one that was built, bit for bit. An outline with any
// contents gives a sound hierarchy or is refused.

#include <abut/model.h>

#include "math/transform.h"
#include "rigid/model/model_data.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/tree/trees.h"
#include "tree/outline.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iostream>

namespace abut::test {
namespace {

/// Triangles of many kinds: a body, an oblique plane, needles, points, repeated triangles.
Mesh some_mesh(Random& random) {
    Mesh mesh;
    switch (random.integer(0, 3)) {
    case 0:
        mesh = torus_mesh(random.uniform(0.5, 3), random.uniform(0.01, 0.4), random.integer(3, 60),
                          random.integer(3, 40));
        break;
    case 1:
        mesh = box_mesh({0, 0, 0}, {1, 2, 3});
        break;
    default: {
        const double scale = std::pow(10, random.integer(-8, 8));
        const int kind = random.integer(0, 4);
        const int most = random.chance(0.3) ? 12 : 3000;
        for (int i = random.integer(1, most); i > 0; --i) {
            Vec3 p = random.in_cube(scale);
            if (kind == 0)
                p.z = 0.1 * p.x;
            if (kind == 1)
                p = {scale * i, 0, 0};
            if (kind == 2)
                p = {};
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.insert(mesh.positions.end(),
                                  {p, p + random.in_cube(kind == 3 ? 0 : 0.05 * scale),
                                   p + random.in_cube(kind == 2 ? 0 : 0.05 * scale)});
            mesh.triangles.push_back({first, first + 1, first + 2});
        }
    }
    }
    const Transform pose = random.pose(random.chance(0.5) ? 0 : 100);
    if (random.chance(0.7))
        for (Vec3& p : mesh.positions)
            p = apply(pose, p);
    if (random.chance(0.5)) // with neighbours in order only by chance
        std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937(1));
    return mesh;
}

TEST(Outline, MakesTheTreeThatWasBuilt) {
    Random random(8301);
    std::size_t turned = 0, plain = 0;
    std::array<std::size_t, kTreeAxes> axes{};
    for (int round = 0; round < many(200); ++round) {
        const Mesh mesh = some_mesh(random);
        const Model built(mesh);
        const ModelOutline outline = built.data().outline();
        ASSERT_TRUE(is_outline(outline.tree, mesh.triangles.size()));
        const Model made(std::make_shared<const ModelData>(mesh, outline));
        expect_same_tree(made.data().tree(), built.data().tree());
        ASSERT_TRUE(same_bytes(made.data().model_from_tree(), built.data().model_from_tree()));
        ASSERT_TRUE(same_bytes(made.data().support(), built.data().support()));
        ASSERT_EQ(made.bytes(), built.bytes());
        ASSERT_EQ(made.data().outline(), outline);
        if (HasFailure()) {
            std::cout << "round " << round << "\n";
            return;
        }
        ++axes.at(static_cast<std::size_t>(outline.axes));
        for (const std::uint32_t node : outline.tree.nodes)
            ++(node >> 24 != 0 ? turned : plain);
    }
    std::cout << turned << " nodes with axes of their own, " << plain << " without; frames "
              << axes[0] << ", " << axes[1] << ", " << axes[2] << "\n";
    EXPECT_GT(turned, plain / 10);
    EXPECT_GT(plain, turned / 10);
    for (const std::size_t count : axes)
        EXPECT_GT(count, static_cast<std::size_t>(many(200)) / 20);
}

TEST(Outline, NoTriangles) {
    const Mesh none{{{1, 2, 3}}, {}};
    const ModelOutline outline = Model(none).data().outline();
    EXPECT_TRUE(is_outline(outline.tree, 0));
    EXPECT_FALSE(is_outline(outline.tree, 1));
    EXPECT_TRUE(ModelData(none, outline).tree().empty());
}

/// Makes one random change, often a small one.
void spoil(Random& random, TreeOutline& outline) {
    const auto some = [&](const auto& list) {
        return static_cast<std::size_t>(random.integer(0, static_cast<int>(list.size()) - 1));
    };
    switch (random.integer(0, 6)) {
    case 0:
        outline.nodes[some(outline.nodes)] ^= 1U << random.integer(0, 26);
        break;
    case 1:
        outline.order[some(outline.order)] =
            static_cast<std::uint32_t>(random.integer(0, static_cast<int>(outline.order.size())));
        break;
    case 2: // another outline, but sound
        std::swap(outline.order[some(outline.order)], outline.order[some(outline.order)]);
        break;
    case 3:
        outline.nodes.resize(some(outline.nodes));
        break;
    case 4:
        outline.nodes.insert(outline.nodes.begin() +
                                 static_cast<std::ptrdiff_t>(some(outline.nodes)),
                             outline.nodes[some(outline.nodes)]);
        break;
    case 5: // the node gains or loses axes of its own
        outline.nodes[some(outline.nodes)] ^= 1U << 24;
        break;
    default:
        std::swap(outline.nodes[some(outline.nodes)], outline.nodes[some(outline.nodes)]);
    }
}

TEST(Outline, AnyContentsMakeASoundTreeOrAreRefused) {
    Random random(8302);
    std::size_t refused = 0, other = 0;
    for (int round = 0; round < many(1600); ++round) {
        const Mesh mesh = some_mesh(random);
        const ModelOutline built = Model(mesh).data().outline();
        TreeOutline outline = built.tree;
        for (int i = random.integer(1, 3); i > 0 && !outline.nodes.empty(); --i)
            spoil(random, outline);
        if (!is_outline(outline, mesh.triangles.size())) {
            ++refused;
            continue;
        }
        const TreeMesh tree_mesh{mesh.positions, mesh.triangles};
        ASSERT_NO_THROW(validate(build_tree(tree_mesh, outline), tree_mesh)) << "round " << round;
        other += outline == built.tree ? 0 : 1;
    }
    std::cout << refused << " refused, " << other << " made another tree\n";
    EXPECT_GT(refused, static_cast<std::size_t>(many(1600)) / 5);
    EXPECT_GT(other, static_cast<std::size_t>(many(1600)) / 10);
}

/// A chain of nodes with one child each would be as deep as it has nodes.
TEST(Outline, ChainsAreRefused) {
    constexpr std::uint32_t kNodeThenLeaf = 5 | 1 << 3, kTwoLeaves = 1 | 1 << 3;
    const auto chain = [](std::uint32_t inner, std::size_t nodes) {
        TreeOutline outline;
        outline.nodes.assign(nodes, inner);
        outline.nodes.back() = kTwoLeaves;
        for (std::uint32_t i = 0; i <= (inner == kNodeThenLeaf ? nodes : 1); ++i)
            outline.order.push_back(i);
        return outline;
    };
    EXPECT_TRUE(is_outline(chain(kNodeThenLeaf, 100), 101));
    EXPECT_FALSE(is_outline(chain(kNodeThenLeaf, 100'000), 100'001));
    EXPECT_FALSE(is_outline(chain(5, 100), 2));
}

/// Guards the format. If this test fails, the builder has changed: increase TreeOutline::kFormat,
/// so that stored outlines of the old builder are not used, and update the hash here.
TEST(Outline, AFixedMeshGivesTheBytesOfTheFormat) {
    Mesh mesh; // whole numbers give the same tree on every machine
    constexpr int kSide = 60;
    for (int i = 0; i <= kSide; ++i)
        for (int k = 0; k <= kSide; ++k)
            mesh.positions.push_back(
                {double(i), double((7 * i * i + 3 * k * k + i * k) % 31), double(k)});
    for (std::uint32_t i = 0; i < kSide; ++i)
        for (std::uint32_t k = 0; k < kSide; ++k) {
            const std::uint32_t at = i * (kSide + 1) + k, next = at + kSide + 1;
            mesh.triangles.push_back({at, at + 1, next});
            mesh.triangles.push_back({next, at + 1, next + 1});
        }
    const TreeOutline outline = outline_of(build_tree(TreeMesh{mesh.positions, mesh.triangles}));
    std::uint64_t hash = 1469598103934665603U; // FNV-1a
    const auto add = [&](std::uint32_t word) { hash = (hash ^ word) * 1099511628211U; };
    for (const std::uint32_t node : outline.nodes)
        add(node & 0xffffff); // without the axes' bits, which may depend on the last bit of a sum
    for (const std::uint32_t triangle : outline.order)
        add(triangle);
    EXPECT_EQ(TreeOutline::kFormat, 1U);
    EXPECT_EQ(hash, 9170898785839253576U);
}

} // namespace
} // namespace abut::test
