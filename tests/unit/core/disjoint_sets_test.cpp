#include "core/disjoint_sets.h"

#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace abut {
namespace {

TEST(DisjointSets, RootsAreTheLeastMembers) {
    DisjointSets sets(7);
    EXPECT_EQ(sets.root(6), 6U);
    EXPECT_EQ(sets.unite(6, 4), 4U);
    EXPECT_EQ(sets.unite(5, 3), 3U);
    EXPECT_EQ(sets.unite(6, 5), 3U);
    EXPECT_EQ(sets.unite(4, 3), 3U); // they are in one set already
    EXPECT_EQ(sets.unite(1, 2), 1U);
    for (const std::uint32_t i : {3U, 4U, 5U, 6U})
        EXPECT_EQ(sets.root(i), 3U);
    EXPECT_EQ(std::move(sets).roots(), (std::vector<std::uint32_t>{0, 1, 1, 3, 3, 3, 3}));
}

TEST(DisjointSets, AStartFromParentsKeepsTheirSets) {
    DisjointSets sets(std::vector<std::uint32_t>{0, 0, 1, 3, 3});
    EXPECT_EQ(sets.root(2), 0U);
    EXPECT_EQ(sets.unite(4, 2), 0U);
    EXPECT_EQ(std::move(sets).roots(), (std::vector<std::uint32_t>{0, 0, 0, 0, 0}));
}

TEST(DisjointSets, AChainOfManyEndsInOneSet) {
    constexpr std::uint32_t kCount = 10000;
    DisjointSets sets(kCount);
    for (std::uint32_t i = kCount - 1; i > 0; --i)
        EXPECT_EQ(sets.unite(i, i - 1), i - 1);
    EXPECT_EQ(std::move(sets).roots(), std::vector<std::uint32_t>(kCount, 0));
}

} // namespace
} // namespace abut
