// Parts whose surface lies wholly in the material of another part.

#include <abut/clash.h>

#include "tests/support/shapes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace abut::test {
namespace {

std::vector<Clash> clashes_of(const Mesh& a, const Mesh& b, double touch) {
    std::vector<Scene> models(2);
    models[0].meshes = {a}, models[1].meshes = {b};
    models[0].parts = {{"a", "", "", 0, {}}}, models[1].parts = {{"b", "", "", 0, {}}};
    ClashOptions options;
    options.touch_tolerance = touch;
    return find_clashes(models, options).clashes;
}

/// A block around the cavity of a hollow box: its surface lies in the material, and the cavity in it is
/// not common.
TEST(ContainedParts, ABlockThatFillsACavityAndMore) {
    const Mesh cavity = reversed(box_mesh({4, 4, 4}, {6, 6, 6})),
               hollow = joined(box_mesh({0, 0, 0}, {10, 10, 10}), cavity),
               block = box_mesh({3, 3, 3}, {7, 7, 7});
    for (const double touch : {0.0, 0.01})
        for (const bool exchanged : {false, true}) {
            const auto found =
                exchanged ? clashes_of(block, hollow, touch) : clashes_of(hollow, block, touch);
            ASSERT_EQ(found.size(), 1U);
            EXPECT_EQ(found[0].kind, ClashKind::contained);
            EXPECT_NEAR(found[0].distance, -1, 1e-12); // to the cavity
            EXPECT_LE(std::abs(found[0].volume - (64 - 8)), found[0].volume_error);
            EXPECT_LE(found[0].volume_error, 1e-6);
        }
}

/// A block around one of two cavities, with one of its own; it lies in the material all the same.
TEST(ContainedParts, CavitiesOfBothParts) {
    Mesh hollow =
        joined(box_mesh({0, 0, 0}, {10, 10, 10}), reversed(box_mesh({4, 4, 4}, {5, 5, 5})));
    hollow = joined(hollow, reversed(box_mesh({8.5, 8.5, 8.5}, {9, 9, 9})));
    const Mesh block =
        joined(box_mesh({3, 3, 3}, {8, 8, 8}), reversed(box_mesh({6, 6, 6}, {7, 7, 7})));
    const auto found = clashes_of(hollow, block, 0.01);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].kind, ClashKind::contained);
    EXPECT_LE(std::abs(found[0].volume - (125 - 1 - 1)), found[0].volume_error);
    EXPECT_LE(found[0].volume_error, 1e-6);
}

TEST(ContainedParts, WhatLiesInACavityIsNotContained) {
    const Mesh hollow =
        joined(box_mesh({0, 0, 0}, {10, 10, 10}), reversed(box_mesh({4, 4, 4}, {6, 6, 6})));
    EXPECT_TRUE(clashes_of(hollow, box_mesh({4.5, 4.5, 4.5}, {5.5, 5.5, 5.5}), 0.01).empty());
    const auto beside = clashes_of(hollow, box_mesh({1, 1, 1}, {2, 2, 2}), 0.01);
    ASSERT_EQ(beside.size(), 1U);
    EXPECT_EQ(beside[0].kind, ClashKind::contained);
    EXPECT_NEAR(beside[0].distance, -1, 1e-12);
    EXPECT_NEAR(beside[0].volume, 1, 1e-9);
}

} // namespace
} // namespace abut::test
