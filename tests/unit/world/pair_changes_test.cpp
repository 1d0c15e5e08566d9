// Changes of a sorted list of pairs, against sets.

#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "world/broad_phase/pair_changes.h"

#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace abut::test {
namespace {

using Pairs = std::vector<IndexPair>;

TEST(PairChanges, LeaveOutPairsThatAreAgainAsTheyWere) {
    PairChanges changes;
    const IndexPair one(0, 1), two(0, 2), three(1, 2);
    changes.add(Pairs{one, two}, Pairs{three});
    changes.add(Pairs{three}, Pairs{one});
    EXPECT_EQ(changes.size(), 5U);
    const auto settled = changes.settle();
    ASSERT_EQ(settled.size(), 1U);
    EXPECT_EQ(settled[0].pair, two);
    EXPECT_EQ(settled[0].by, 1);
    Pairs pairs{three};
    apply(settled, pairs);
    EXPECT_EQ(pairs, (Pairs{two, three}));
    changes.clear();
    apply(changes.settle(), pairs);
    EXPECT_EQ(pairs.size(), 2U);
}

TEST(PairChanges, ListsAndValuesFollowSeveralSteps) {
    Random random(9101);
    std::size_t begun_in_all = 0, ended_in_all = 0;
    for (int round = 0; round < many(200); ++round) {
        const int boxes = random.integer(2, 12);
        const double share = random.uniform(0, 1);
        std::set<IndexPair> now;
        for (std::uint32_t i = 0; i < std::uint32_t(boxes); ++i)
            for (std::uint32_t k = i + 1; k < std::uint32_t(boxes); ++k)
                if (random.chance(share))
                    now.emplace(i, k);
        Pairs pairs(now.begin(), now.end());
        // The value of a pair that has stayed is its key; that of a new one is 0.
        std::vector<std::uint64_t> values;
        for (const IndexPair pair : pairs)
            values.push_back(pair.key());
        const std::set<IndexPair> first = now;
        PairChanges changes;
        for (int step = random.integer(0, 4); step > 0; --step) {
            Pairs begun, ended;
            for (std::uint32_t i = 0; i < std::uint32_t(boxes); ++i)
                for (std::uint32_t k = i + 1; k < std::uint32_t(boxes); ++k)
                    if (random.chance(0.3))
                        (now.contains({i, k}) ? ended : begun).emplace_back(i, k);
            for (const IndexPair pair : begun)
                now.insert(pair);
            for (const IndexPair pair : ended)
                now.erase(pair);
            changes.add(begun, ended);
            begun_in_all += begun.size(), ended_in_all += ended.size();
        }
        const Pairs truth(now.begin(), now.end());
        apply(changes.settle(), pairs);
        ASSERT_EQ(pairs, truth);
        apply(changes.settle(), pairs, values);
        ASSERT_EQ(values.size(), truth.size());
        for (std::size_t i = 0; i < truth.size(); ++i)
            ASSERT_EQ(values[i], first.contains(truth[i]) ? truth[i].key() : 0);
    }
    EXPECT_GT(begun_in_all, 500U);
    EXPECT_GT(ended_in_all, 500U);
}

} // namespace
} // namespace abut::test
