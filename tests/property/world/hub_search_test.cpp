// The search for hubs, boxes that meet a large share of all others and are treated separately:
// against all pairs, step by step.

#include <abut/progress.h>

#include "tests/support/box_script.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"
#include "world/broad_phase/pair_search.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

namespace abut::test {
namespace {

std::size_t empty_boxes(std::span<const Box3> boxes) {
    return static_cast<std::size_t>(
        std::count_if(boxes.begin(), boxes.end(), [](const Box3& b) { return b == Box3(); }));
}

/// Input of the inner search, which takes all boxes but hubs.
struct Seen {
    std::size_t empty = 0;    ///< boxes in the last step
    std::size_t restarts = 0; ///< one for each new set of hubs
};

/// A search of all boxes but hubs that records what it is given.
class Witness final : public PairSearch {
public:
    Witness(PairFilter filter, Seen& seen)
        : search_(make_tree_search(std::move(filter))), seen_(seen) {}
    void update(const BoxStep& step, PairList& list) override {
        seen_.empty = empty_boxes(step.boxes);
        search_->update(step, list);
    }
    void restart(std::span<const Box3> boxes, PairList& list) override {
        seen_.empty = empty_boxes(boxes), ++seen_.restarts;
        search_->restart(boxes, list);
    }

private:
    std::unique_ptr<PairSearch> search_;
    Seen& seen_;
};

struct Counts {
    std::size_t steps = 0, with_hubs = 0, restarts = 0, changes = 0;
};

/// Runs one script with a new search, which begins with a restart, as after `forget`.
void run_script(Random& random, const BoxSceneKind& kind, const PairFilter& filter,
                Counts& counts) {
    Seen seen;
    const auto search = make_hub_search(std::make_unique<Witness>(filter, seen), filter);
    BoxScript script(random, kind, std::size_t(random.integer(30, 400)));
    PairList list;
    search->restart(script.boxes(), list);
    Pairs last = all_pairs(script.boxes(), {{}, filter});
    ASSERT_EQ(list.pairs(), last);
    for (int i = 0; i < 40; ++i) {
        const std::size_t before = script.boxes().size();
        auto changed = script.step();
        if (random.chance(0.5)) {
            changed.resize(script.boxes().size());
            std::iota(changed.begin(), changed.end(), 0);
        }
        if (random.chance(0.02))
            search->restart(script.boxes(), list);
        else
            search->update({script.boxes(), changed}, list);
        const Pairs now = all_pairs(script.boxes(), {{}, filter});
        ASSERT_EQ(list.pairs(), now) << i << " " << before;
        ASSERT_EQ(list.begun(), without(now, last));
        ASSERT_EQ(list.ended(), without(last, now));
        ++counts.steps, counts.changes += list.begun().size() + list.ended().size();
        counts.with_hubs += seen.empty > empty_boxes(script.boxes()) ? 1 : 0;
        last = now;
    }
    counts.restarts += seen.restarts;
}

TEST(HubSearch, FindsAllPairsAndChangesWhileHubsComeAndGo) {
    Random random(5011);
    Counts counts;
    const PairFilter some = [](std::uint32_t i, std::uint32_t k) { return (i + k) % 4 != 0; };
    const int rounds = many(12);
    for (int round = 0; round < rounds; ++round)
        for (const BoxSceneKind& kind : kBoxSceneKinds)
            for (const PairFilter& filter : {PairFilter(), some}) {
                SCOPED_TRACE(kind.name);
                set_threads(random.integer(1, 4));
                ASSERT_NO_FATAL_FAILURE(run_script(random, kind, filter, counts));
            }
    set_threads(0);
    std::cout << counts.with_hubs << " of " << counts.steps << ", restarts " << counts.restarts
              << " changes " << counts.changes << "\n";
    EXPECT_GT(counts.with_hubs, counts.steps / 8);
    EXPECT_LT(counts.with_hubs, counts.steps * 7 / 8);
    // Each script begins with one restart, and the set of hubs changes in some of the scripts.
    EXPECT_GT(counts.restarts, std::size_t(rounds) * kBoxSceneKinds.size() * 2 * 3 / 2);
    EXPECT_GT(counts.changes, counts.steps * 50);
}

TEST(HubSearch, FindsTheSameWithEverySimdTargetAndNumberOfThreads) {
    Random random(5012);
    // Enough boxes for several tasks to share the rows.
    const BoxSceneKind kind{"with_hubs", 0, 0, 4, false, 0.02};
    BoxScript first(random, kind, 3000);
    const std::vector<Box3> before = first.boxes();
    while (first.step().size() < before.size()) {
    }
    const std::vector<Box3>& after = first.boxes();
    std::vector<std::uint32_t> all(after.size());
    std::iota(all.begin(), all.end(), 0);
    const Pairs truth_before = all_pairs(before, {}), truth = all_pairs(after, {});
    int rounds = 0;
    for_each_simd_target([&](const std::string& target) {
        SCOPED_TRACE(target);
        for (const int threads : {1, 3}) {
            set_threads(threads);
            Seen seen;
            const auto search = make_hub_search(std::make_unique<Witness>(PairFilter(), seen), {});
            PairList list;
            search->restart(before, list);
            std::vector<std::uint32_t> as_before(before.size());
            std::iota(as_before.begin(), as_before.end(), 0);
            search->update({before, as_before}, list);
            EXPECT_GT(seen.empty, empty_boxes(before) + 20);
            EXPECT_TRUE(list.begun().empty() && list.ended().empty());
            search->update({after, all}, list);
            EXPECT_TRUE(list.pairs() == truth);
            EXPECT_TRUE(list.begun() == without(truth, truth_before));
            EXPECT_TRUE(list.ended() == without(truth_before, truth));
            ++rounds;
        }
    });
    set_threads(0);
    EXPECT_GT(rounds, 1);
}

/// Without changes the list stays in place. A change of one box or hub changes only the pairs of
/// that box or hub.
TEST(HubSearch, KeepsTheListWhereNothingChanges) {
    std::vector<Box3> boxes(200);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const auto x = double(i);
        boxes[i] = {{x, 0, 0}, {x + 0.5, 1, 1}};
    }
    for (std::size_t i = 0; i < 10; ++i)
        boxes[20 * i] = {{-1, 0, 0}, {300, 1, 1}};
    const auto search = make_hub_search(make_tree_search({}), {});
    PairList list;
    search->restart(boxes, list);
    EXPECT_EQ(list.pairs().size(), 190U * 10 + 45);
    boxes[7].upper.x += 0.25;
    search->update({boxes, std::vector<std::uint32_t>{7}}, list);
    const IndexPair* const data = list.pairs().data();
    boxes[7].upper.x -= 0.25;
    search->update({boxes, std::vector<std::uint32_t>{7}}, list);
    EXPECT_EQ(list.pairs().data(), data);
    boxes[7].upper.x += 1;
    search->update({boxes, std::vector<std::uint32_t>{7}}, list);
    EXPECT_EQ(list.begun(), Pairs{IndexPair(7, 8)});
    boxes[20] = Box3();
    search->update({boxes, std::vector<std::uint32_t>{20}}, list);
    EXPECT_EQ(list.ended().size(), 199U);
    EXPECT_TRUE(list.begun().empty());
    EXPECT_EQ(list.pairs(), all_pairs(boxes, {}));
}

} // namespace
} // namespace abut::test
