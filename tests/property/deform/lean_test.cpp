// A lean surface, which keeps no boxes of features, gives the answers of any other surface. Each test
// prints its seed's hits.

#include <abut/deformable.h>

#include "deform/deformable_data.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/rounds.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <iostream>

namespace abut::test {
namespace {

constexpr DeformableOptions kLean{.lean = true};

/// Compares every query of two surfaces and of each alone. Returns the number of impacts.
std::size_t expect_same_answers(const Deformable& a, const Deformable& lean_a, const Deformable& b,
                                const Deformable& lean_b) {
    const Impacts own = self_impacts(a), both = impacts(a, b);
    const Impacts lean_own = self_impacts(lean_a);
    EXPECT_EQ(lean_own.list, own.list);
    EXPECT_EQ(lean_own.counters, own.counters);
    EXPECT_EQ(impacts(lean_a, lean_b).list, both.list);
    EXPECT_EQ(impacts(lean_a, b).list, both.list);
    EXPECT_EQ(self_time_of_impact(lean_a), self_time_of_impact(a));
    EXPECT_EQ(time_of_impact(lean_a, lean_b), time_of_impact(a, b));
    EXPECT_EQ(is_free_of_self_impacts(lean_a), own.list.empty());
    EXPECT_EQ(is_free_of_impacts(a, lean_b), both.list.empty());
    EXPECT_EQ(self_within(lean_a, 0.05), self_within(a, 0.05));
    EXPECT_EQ(within(lean_a, lean_b, 0.05), within(a, b, 0.05));
    for (const bool at_end : {false, true}) {
        EXPECT_EQ(self_intersections(lean_a, {.at_end = at_end}),
                  self_intersections(a, {.at_end = at_end}));
        EXPECT_EQ(intersections(a, lean_b, {.at_end = at_end}),
                  intersections(a, b, {.at_end = at_end}));
    }
    return own.list.size() + both.list.size();
}

TEST(LeanDeformable, AnswersAreTheSame) {
    Random random(83);
    std::size_t hits = 0;
    for (int round = 0; round < many(6); ++round) {
        MovingMesh a = crumpled_sheet(random, random.integer(2, 24)), b = random_soup(random, 9, 8);
        Deformable fat_a = a.deformable(), lean_a = a.deformable(kLean);
        Deformable fat_b = b.deformable(), lean_b = b.deformable(kLean);
        for (int step = 0; step < 3; ++step) {
            hits += expect_same_answers(fat_a, lean_a, fat_b, lean_b);
            for (Vec3& p : a.end)
                p = p + random.in_cube(step == 1 ? 1 : 0.05);
            for (Deformable* surface : {&fat_a, &lean_a})
                surface->advance(a.end);
        }
        Mesh cut = a.mesh;
        cut.triangles.pop_back();
        for (Deformable* surface : {&fat_a, &lean_a}) {
            surface->set_mesh(cut);
            surface->advance(a.end);
        }
        hits += expect_same_answers(fat_a, lean_a, fat_b, lean_b);
    }
    std::cout << hits << " hits\n";
    EXPECT_GT(hits, 1000U);
}

TEST(LeanDeformable, TakesAtMost100BytesATriangle) {
    Random random(7);
    const MovingMesh moving = crumpled_sheet(random, 60);
    const auto bytes = [&](const Deformable& surface) {
        return static_cast<double>(surface.bytes()) /
               static_cast<double>(moving.mesh.triangles.size());
    };
    EXPECT_LT(bytes(moving.deformable(kLean)), 100);
    EXPECT_GT(bytes(moving.deformable()), 200);
}

} // namespace
} // namespace abut::test
