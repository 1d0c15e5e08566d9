// Lists of pairs of any length, above all around multiples of what a task compares, against sets.

#include <abut/progress.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "world/broad_phase/pair_list.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>
#include <vector>

namespace abut::test {
namespace {

using SortedPairs = std::vector<IndexPair>;
constexpr std::size_t kBlock = PairList::kPairsOfTask;

SortedPairs difference(const SortedPairs& a, const SortedPairs& b) {
    SortedPairs rest;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
    return rest;
}

/// A random choice of `count` pairs of two rows of boxes, sorted.
SortedPairs some_pairs(Random& random, std::uint32_t row, std::size_t count) {
    SortedPairs all;
    for (std::uint32_t i = 0; i < row; ++i)
        for (std::uint32_t k = 0; k < row; ++k)
            all.emplace_back(i, row + k);
    for (std::size_t i = 0; i < count; ++i)
        std::swap(all[i], all[std::size_t(random.integer(int(i), int(all.size()) - 1))]);
    all.resize(count);
    std::sort(all.begin(), all.end());
    return all;
}

/// The pairs, shuffled into lists as the tasks of a search find them.
std::vector<SortedPairs> as_found(Random& random, const SortedPairs& pairs) {
    std::vector<SortedPairs> found(std::size_t(random.integer(1, 9)));
    for (const IndexPair pair : pairs)
        found[std::size_t(random.integer(0, int(found.size()) - 1))].push_back(pair);
    return found;
}

class PairListOfLength : public testing::TestWithParam<std::size_t> {};

/// The storage of a list is that of the list before the last one. So each list of the length that
/// is tested follows two longer ones, whose pairs lie beyond its end.
TEST_P(PairListOfLength, TellsWhatBeganAndEnded) {
    constexpr std::uint32_t kRow = 220;
    const std::size_t length = GetParam();
    Random random(9102);
    std::size_t begun = 0, ended = 0, stayed = 0;
    for (int round = 0; round < many(3); ++round) {
        set_threads(random.integer(1, 4));
        PairList list;
        SortedPairs last;
        for (const std::size_t count :
             {length + 400, length + 300, length, length, length + 1, std::size_t{0}, length}) {
            const SortedPairs now = some_pairs(random, kRow, count);
            auto found = as_found(random, now);
            list.replace_all(found, 2 * kRow);
            ASSERT_TRUE(list.pairs() == now) << count;
            ASSERT_EQ(list.size(), count);
            ASSERT_TRUE(list.begun() == difference(now, last)) << count;
            ASSERT_TRUE(list.ended() == difference(last, now)) << count;
            begun += list.begun().size(), ended += list.ended().size();
            stayed += now.size() - list.begun().size();
            last = now;
        }
    }
    set_threads(0);
    if (length > 100) {
        EXPECT_GT(begun, length);
        EXPECT_GT(ended, length / 2);
        EXPECT_GT(stayed, length / 2);
    }
}

INSTANTIATE_TEST_SUITE_P(Blocks, PairListOfLength,
                         testing::Values(0, 1, kBlock - 1, kBlock, kBlock + 1, 2 * kBlock - 1,
                                         2 * kBlock, 2 * kBlock + 1));

} // namespace
} // namespace abut::test
