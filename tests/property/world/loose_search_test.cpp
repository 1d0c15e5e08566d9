// Loose boxes against all pairs: boxes drift, tremble, grow, turn back, stand still, become empty or
// endless, and now and then some jump.

#include "tests/support/box_script.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"
#include "world/broad_phase/loose_search.h"

#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace abut::test {
namespace {

class SlowBoxes {
public:
    SlowBoxes(Random& random, std::size_t count) : random_(random), velocities_(count) {
        for (std::size_t i = 0; i < count; ++i) {
            boxes_.push_back(anywhere());
            if (i % 3 != 0)
                velocities_[i] = random_.uniform(0, 0.02) * random_.direction();
        }
    }
    [[nodiscard]] const std::vector<Box3>& boxes() const { return boxes_; }

    void step() {
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            Box3& box = boxes_[i];
            if (i % 7 == 0) // trembles
                velocities_[i] = 0.002 * random_.direction();
            if (random_.chance(0.01))
                velocities_[i] = -velocities_[i];
            box.lower = box.lower + velocities_[i], box.upper = box.upper + velocities_[i];
            if (i % 5 == 0)
                box.upper.x += 0.003;
        }
        for (int jumps = random_.integer(0, 2); jumps > 0; --jumps)
            boxes_[index()] = anywhere();
        if (random_.chance(0.05)) {
            Box3& box = boxes_[index()];
            std::swap(box.lower.y, box.upper.y); // empty, or back again
        }
        if (random_.chance(0.02))
            boxes_[index()].upper.z = std::numeric_limits<double>::infinity();
    }

private:
    std::size_t index() {
        return std::size_t(random_.integer(0, static_cast<int>(boxes_.size()) - 1));
    }
    Box3 anywhere() {
        const Vec3 at{random_.uniform(0, 5), random_.uniform(0, 5), random_.uniform(0, 5)};
        return {at, at + Vec3{random_.uniform(0, 1), random_.uniform(0.5, 1), 1}};
    }

    Random& random_;
    std::vector<Box3> boxes_;
    std::vector<Vec3> velocities_;
};

TEST(LooseSearch, FindsAllPairsAndChanges) {
    Random random(5021);
    std::size_t steps = 0, kept = 0, changes = 0, pairs = 0;
    for (int round = 0; round < many(12); ++round) {
        BroadPhaseOptions options;
        if (round % 2 == 1)
            options.filter = [](std::uint32_t i, std::uint32_t k) { return (i + k) % 3 != 0; };
        SlowBoxes scene(random, std::size_t(random.integer(30, 250)));
        std::vector<std::uint32_t> all(scene.boxes().size());
        std::iota(all.begin(), all.end(), 0);
        LooseSearch search(options.filter);
        PairList list;
        Pairs last = all_pairs(scene.boxes(), options);
        list.assign(last);
        search.begin(scene.boxes());
        for (int i = 0; i < 60; ++i) {
            scene.step();
            const Pairs now = all_pairs(scene.boxes(), options);
            ++steps;
            if (search.try_update({scene.boxes(), all}, list)) {
                ++kept;
                ASSERT_EQ(list.begun(), without(now, last)) << round << ", step " << i;
                ASSERT_EQ(list.ended(), without(last, now)) << round << ", step " << i;
                changes += list.begun().size() + list.ended().size();
            } else {
                list.assign(now);
                search.begin(scene.boxes());
            }
            if (random.chance(0.5)) { // otherwise changes wait
                ASSERT_EQ(list.pairs(), now) << round << ", step " << i;
            }
            ASSERT_EQ(list.size(), now.size());
            last = now;
            pairs += now.size();
        }
    }
    EXPECT_GT(kept, steps * 3 / 4);
    EXPECT_LT(kept, steps);
    EXPECT_GT(changes, steps);
    EXPECT_GT(pairs, steps * 30);
}

TEST(LooseSearch, TestsPairsTheSameWithEverySimdTarget) {
    Random random(5023);
    SlowBoxes scene(random, 80);
    for (int i = 0; i < 30; ++i)
        scene.step();
    std::vector<Box3> boxes = scene.boxes();
    boxes[3] = {{1, 1, 1}, {0, 0, 0}}, boxes[4].lower.x = -std::numeric_limits<double>::infinity();
    const Pairs truth = all_pairs(boxes, {});
    std::vector<BoxLine> lines(boxes.size());
    Pairs pairs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        lines[i].set(boxes[i]);
        for (std::uint32_t k = i + 1; k < boxes.size(); ++k)
            pairs.emplace_back(i, k);
    }
    for_each_simd_target([&](const std::string& target) {
        std::vector<std::uint8_t> meets(pairs.size(), 0);
        std::vector<std::uint32_t> flipped(pairs.size());
        for (const bool again : {false, true}) {
            Pairs found;
            const std::size_t count = find_flipped(lines, pairs, meets, flipped);
            for (std::size_t i = 0; i < count; ++i)
                found.push_back(pairs[flipped[i]]);
            EXPECT_EQ(found, again ? Pairs() : truth) << target;
        }
    });
    EXPECT_GT(truth.size(), 40U);
    EXPECT_LT(truth.size(), pairs.size() / 2);
}

TEST(LooseSearch, GivesUpBoxesThatGoElsewhere) {
    Random random(5022);
    std::vector<std::uint32_t> all(100);
    std::iota(all.begin(), all.end(), 0);
    LooseSearch search({});
    PairList list;
    const SlowBoxes before(random, 100), after(random, 100);
    list.assign(all_pairs(before.boxes(), {}));
    search.begin(before.boxes());
    EXPECT_FALSE(search.try_update({after.boxes(), all}, list));
    EXPECT_EQ(list.pairs(), all_pairs(before.boxes(), {}));
    EXPECT_FALSE(search.try_update({std::span(after.boxes()).first(50), {}}, list));
}

} // namespace
} // namespace abut::test
