// All contacts of whole models against CGAL's tree with exact predicates, on the same world
// positions, where CGAL is installed.

#include <abut/rigid.h>

#include "math/predicates.h"
#include "math/transform.h"
#include "scenes/bodies.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#ifdef ABUT_HAVE_CGAL
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

namespace abut::test {
namespace {

#ifdef ABUT_HAVE_CGAL

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Triangles world_triangles(const Mesh& mesh, const Transform& world) {
    Triangles triangles;
    const auto point = [&](std::uint32_t vertex) {
        const Vec3 p = apply(world, mesh.positions[vertex]);
        return Kernel::Point_3(p.x, p.y, p.z);
    };
    for (const auto& t : mesh.triangles)
        triangles.emplace_back(point(t[0]), point(t[1]), point(t[2]));
    return triangles;
}

std::vector<TrianglePair> expected_pairs(const Mesh& a, const Transform& world_a, const Mesh& b,
                                         const Transform& world_b) {
    const Triangles of_a = world_triangles(a, world_a), of_b = world_triangles(b, world_b);
    const CgalTree tree(of_b.begin(), of_b.end());
    std::vector<TrianglePair> pairs;
    std::vector<Triangles::const_iterator> hits;
    for (std::uint32_t i = 0; i < of_a.size(); ++i) {
        hits.clear();
        tree.all_intersected_primitives(of_a[i], std::back_inserter(hits));
        for (const auto& hit : hits)
            pairs.push_back({i, static_cast<std::uint32_t>(hit - of_b.begin())});
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

/// Triangles between lattice points, so that most pairs that meet only touch. Zero-area triangles
/// are left out, because CGAL does not accept them.
Mesh lattice_soup(Random& random, int count) {
    Mesh mesh;
    while (static_cast<int>(mesh.triangles.size()) < count) {
        const Triangle t = random.lattice_triangle(3);
        if (collinear(t[0], t[1], t[2]))
            continue;
        const Vec3 at = 8 * random.on_lattice(3);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec3& p : t)
            mesh.positions.push_back(p + at);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

TEST(CgalModels, AllContactsOfCurvedBodies) {
    Random random(1411);
    const Mesh rock = scenes::boulder(4000), rope = scenes::knot(4000);
    const Model a(rock), b(rope);
    std::size_t pairs = 0, apart = 0;
    for (int i = 0; i < 60; ++i) {
        // From deep overlap to just apart; every third pair is scaled unevenly.
        Transform world_a = random.pose(0.3), world_b = random.pose(0.3);
        if (i % 3 == 0)
            world_a = compose(world_a, Transform({1.5, 0.2, 0, 0, 0.7, 0.1, 0, 0, 1.1, 0, 0, 0}));
        world_b.m[9] += 0.03 * i;
        const auto expected = expected_pairs(rock, world_a, rope, world_b);
        const Contacts all = collide(a, world_a, b, world_b, {.mode = ContactMode::all});
        ASSERT_EQ(all.pairs, expected) << i;
        EXPECT_EQ(collide(a, world_a, b, world_b).meet(), !expected.empty()) << i;
        EXPECT_EQ(distance(a, world_a, b, world_b).distance == 0, !expected.empty()) << i;
        pairs += expected.size(), apart += expected.empty() ? 1 : 0;
    }
    EXPECT_GT(pairs, 5000U);
    EXPECT_GT(apart, 5U);
    EXPECT_LT(apart, 50U);
}

TEST(CgalModels, AllContactsOnLattices) {
    Random random(1412);
    std::size_t pairs = 0;
    for (int i = 0; i < 40; ++i) {
        const Mesh soup_a = lattice_soup(random, 600), soup_b = lattice_soup(random, 600);
        const Model a(soup_a), b(soup_b);
        Transform moved;
        for (std::size_t axis = 9; axis < 12; ++axis)
            moved.m[axis] = random.integer(-3, 3);
        const auto expected = expected_pairs(soup_a, {}, soup_b, moved);
        ASSERT_EQ(collide(a, {}, b, moved, {.mode = ContactMode::all}).pairs, expected) << i;
        pairs += expected.size();
    }
    EXPECT_GT(pairs, 2000U);
}

#else

TEST(CgalModels, AllContacts) {
    GTEST_SKIP() << "libcgal-dev was not there when this was built";
}

#endif

} // namespace
} // namespace abut::test
