// A traversal of two box trees visits every pair of triangles within the bound.

#include "tests/support/simd_targets.h"
#include "tests/support/tree/traversal.h"

#include <gtest/gtest.h>
#include <string>

namespace abut::test {
namespace {

class TraversePair : public testing::TestWithParam<SceneKind> {};

TEST_P(TraversePair, VisitsEveryPairWithinTheBound) {
    const SceneKind& kind = GetParam();
    Random random(901);
    Tally tally;
    for (int round = 0; round < 8; ++round) {
        const TreeScene s(random, kind, 150);
        const PairTruth truth(s, kind.size);
        const Vec3 direction = random.direction();
        const PairFrame frame = make_pair_frame(s.a.tree, s.world_a, s.b.tree, s.world_b);
        ASSERT_TRUE(frame.valid);
        for_each_simd_target([&](const std::string& target) {
            SCOPED_TRACE(target);
            PairTraversal pair{s.a.tree, s.b.tree, frame};
            expect_no_pair_lost(s, truth, direction, pair, pair, tally);
        });
    }
    EXPECT_GT(tally.met, 100U);
    EXPECT_GT(tally.crossed, tally.met * 6 / 10); // decided without exact arithmetic
    EXPECT_GT(tally.accepted, 0U);
    EXPECT_GT(tally.within, 300U);
    EXPECT_LT(tally.visited, tally.total / 2);
}

INSTANTIATE_TEST_SUITE_P(Kinds, TraversePair, testing::ValuesIn(kSceneKinds),
                         [](const auto& tested) { return std::string(tested.param.name); });

} // namespace
} // namespace abut::test
