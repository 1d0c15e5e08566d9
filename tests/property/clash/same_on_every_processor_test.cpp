// The clash of a pair has the same bits on every processor, whatever SIMD instructions it has.

#include "tests/support/classified_pair.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>
#include <optional>
#include <string>

namespace abut::test {
namespace {

/// Bodies whose deepest point the search does not find exactly: many triangles at equal distances.
Mesh many_sided(Random& random) {
    switch (random.integer(0, 3)) {
    case 0:
        return sphere_mesh(1, random.integer(8, 40), random.integer(6, 30));
    case 1:
        return torus_mesh(1, 0.4, random.integer(8, 40), random.integer(6, 20));
    case 2:
        return prism_mesh(-1, 1, 0.7, random.integer(8, 60));
    default:
        return ring_mesh(-1, 1, 0.5, 0.9, random.integer(8, 60));
    }
}

TEST(SameOnEveryProcessor, ClashesOfPairs) {
    Random random(1711);
    const int rounds = many(120);
    int deep = 0;
    for (int round = 0; round < rounds; ++round) {
        const Mesh a = many_sided(random), b = many_sided(random);
        const Transform world_a = random.pose(0.2), world_b = random.pose(0.9);
        const double touch = random.chance(0.5) ? 0 : random.uniform(0.01, 0.4);
        std::optional<Clash> first;
        bool is_first = true;
        for_each_simd_target([&](const std::string& /*target*/) {
            const std::optional<Clash> clash = classified(a, b, touch, world_a, world_b, 0.1);
            if (is_first) {
                first = clash;
                is_first = false;
                return;
            }
            ASSERT_EQ(clash.has_value(), first.has_value());
            if (!clash)
                return;
            EXPECT_EQ(clash->kind, first->kind);
            EXPECT_EQ(clash->distance, first->distance);
            EXPECT_EQ(clash->point_a, first->point_a);
            EXPECT_EQ(clash->point_b, first->point_b);
            EXPECT_EQ(clash->direction, first->direction);
            EXPECT_EQ(clash->volume, first->volume);
        });
        deep += first && first->distance < -0.01 ? 1 : 0;
    }
    EXPECT_GT(deep, rounds / 4);
}

} // namespace
} // namespace abut::test
