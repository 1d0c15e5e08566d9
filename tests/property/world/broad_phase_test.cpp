// Every broad phase against all pairs, after each step of scripts of changes. Boxes drift,
// teleport, come, go, coincide, touch, are points, or span the world.

#include <abut/broad_phase.h>
#include <abut/error.h>
#include <abut/progress.h>

#include "math/dyadic.h"
#include "tests/support/box_script.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"
#include "world/broad_phase/box_strips.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <thread>

namespace abut::test {
namespace {

constexpr std::array kMethods{BroadPhaseMethod::automatic, BroadPhaseMethod::tree,
                              BroadPhaseMethod::sweep, BroadPhaseMethod::sweep_and_prune};

/// Options without a filter, and with one that leaves out a third of the pairs.
std::vector<BroadPhaseOptions> options_of(BroadPhaseMethod method) {
    return {{method, {}},
            {method, [](std::uint32_t i, std::uint32_t k) { return (i + k) % 3 != 0; }}};
}

class BroadPhases : public testing::TestWithParam<BoxSceneKind> {};

TEST_P(BroadPhases, FindAllPairsAndChanges) {
    Random random(5001);
    std::size_t steps = 0, pairs = 0, changes = 0, boxes = 0;
    for (int round = 0; round < many(3); ++round)
        for (const BroadPhaseMethod method : kMethods)
            for (const BroadPhaseOptions& options : options_of(method)) {
                SCOPED_TRACE(to_string(method));
                set_threads(random.integer(1, 4));
                const int count =
                    random.chance(0.1) ? random.integer(0, 3) : random.integer(20, 700);
                BoxScript script(random, GetParam(), std::size_t(count));
                BroadPhase phase(options);
                phase.update(script.boxes());
                Pairs last = all_pairs(script.boxes(), options);
                ASSERT_EQ(phase.pairs(), last);
                ASSERT_EQ(phase.begun(), last);
                for (int i = 0; count > 0 && i < 12; ++i) {
                    const auto changed = script.step();
                    if (random.chance(0.3))
                        phase.update(script.boxes());
                    else
                        phase.update(script.boxes(), changed);
                    const Pairs now = all_pairs(script.boxes(), options);
                    ASSERT_EQ(phase.pairs(), now);
                    ASSERT_EQ(phase.begun(), without(now, last));
                    ASSERT_EQ(phase.ended(), without(last, now));
                    changes += phase.begun().size() + phase.ended().size();
                    pairs += now.size(), boxes += script.boxes().size(), ++steps;
                    last = now;
                }
            }
    set_threads(0);
    // Boxes have partners, and the pairs change.
    EXPECT_GT(pairs, boxes / 2);
    EXPECT_LT(pairs, boxes * (GetParam().hubs > 0 ? 200 : 40));
    EXPECT_GT(changes, boxes / 4);
    EXPECT_GT(steps, 100U);
}

TEST_P(BroadPhases, FollowFewChanges) {
    Random random(5011);
    std::size_t changes = 0, reads = 0, steps = 0;
    for (int round = 0; round < many(2); ++round)
        for (const BroadPhaseMethod method : kMethods)
            for (const BroadPhaseOptions& options : options_of(method)) {
                SCOPED_TRACE(to_string(method));
                set_threads(random.integer(1, 4));
                BoxScript script(random, GetParam(), std::size_t(random.integer(60, 300)));
                BroadPhase phase(options);
                phase.update(script.boxes());
                Pairs last = all_pairs(script.boxes(), options);
                for (int i = 0; i < 40; ++i) {
                    if (random.chance(0.05)) {
                        const auto changed = script.step();
                        phase.update(script.boxes(), changed);
                    } else {
                        const auto changed = script.few();
                        phase.update(script.boxes(), changed);
                    }
                    const Pairs now = all_pairs(script.boxes(), options);
                    ASSERT_EQ(phase.begun(), without(now, last));
                    ASSERT_EQ(phase.ended(), without(last, now));
                    if (random.chance(0.3)) { // changes of several steps wait
                        ASSERT_EQ(phase.pairs(), now);
                        ++reads;
                    }
                    changes += phase.begun().size() + phase.ended().size();
                    last = now;
                    ++steps;
                }
                ASSERT_EQ(phase.pairs(), last);
            }
    set_threads(0);
    EXPECT_GT(changes, steps);
    EXPECT_GT(reads, steps / 6);
    EXPECT_LT(reads, steps / 2);
}

TEST_P(BroadPhases, FindTheSameWithEverySimdTarget) {
    Random random(5002);
    std::size_t found = 0;
    for (int round = 0; round < 4; ++round) {
        const BoxScript script(random, GetParam(), 300);
        const Pairs truth = all_pairs(script.boxes(), {});
        for_each_simd_target([&](const std::string& target) {
            SCOPED_TRACE(target);
            EXPECT_EQ(overlapping_boxes(script.boxes()), truth);
            EXPECT_EQ(overlaps_by_strips(script.boxes(), 0, {}, 5), truth);
        });
        found += truth.size();
    }
    EXPECT_GT(found, 100U);
}

INSTANTIATE_TEST_SUITE_P(Kinds, BroadPhases, testing::ValuesIn(kBoxSceneKinds),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(BroadPhase, LongDriftsKeepAllPairs) {
    Random random(5003);
    for (const BroadPhaseMethod method : kMethods) {
        SCOPED_TRACE(to_string(method));
        std::vector<Box3> boxes;
        std::vector<Vec3> ways;
        for (int i = 0; i < 400; ++i) {
            const Vec3 p = random.in_cube(0.5);
            boxes.push_back({p, p + Vec3{0.1, 0.1, 0.1}});
            ways.push_back(random.in_cube(0.01));
        }
        BroadPhase phase({method, {}});
        std::size_t changes = 0;
        for (int step = 0; step < 200; ++step) {
            phase.update(boxes);
            ASSERT_EQ(phase.pairs(), all_pairs(boxes, {}));
            changes += phase.begun().size();
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                const Vec3& p = boxes[i].lower;
                for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z})
                    if (std::abs(p.*axis) > 0.5)
                        ways[i].*axis = -std::copysign(ways[i].*axis, p.*axis);
                boxes[i] = {boxes[i].lower + ways[i], boxes[i].upper + ways[i]};
            }
        }
        EXPECT_GT(changes, 2000U);
    }
}

TEST(BroadPhase, FewBoxesThatJumpForeverAreFoundInAWornTree) {
    Random random(5012);
    BroadPhase phase({BroadPhaseMethod::tree, {}});
    const BoxSceneKind kind{"scattered", 0, 0, 4, false};
    std::vector<Box3> boxes = BoxScript(random, kind, 400).boxes();
    phase.update(boxes);
    for (int step = 0; step < 600; ++step) {
        std::vector<std::uint32_t> changed;
        for (int i = 0; i < 10; ++i) {
            const std::size_t k = std::size_t(step * 10 + i * 7) % boxes.size();
            const Vec3 way = random.in_cube(0.5) - boxes[k].lower;
            boxes[k] = {boxes[k].lower + way, boxes[k].upper + way};
            if (std::find(changed.begin(), changed.end(), k) == changed.end())
                changed.push_back(std::uint32_t(k));
        }
        phase.update(boxes, changed);
        if (step % 20 == 0) {
            ASSERT_EQ(phase.pairs(), all_pairs(boxes, {}));
        }
    }
    EXPECT_EQ(phase.pairs(), all_pairs(boxes, {}));
    EXPECT_GT(phase.pairs().size(), 400U);
}

TEST(BroadPhase, SeveralThreadsReadPairsThatWait) {
    Random random(5013);
    const BoxSceneKind kind{"scattered", 0, 0, 8, false};
    BoxScript script(random, kind, 400);
    BroadPhase phase;
    phase.update(script.boxes());
    for (int step = 0; step < 20; ++step) {
        const auto changed = script.few();
        phase.update(script.boxes(), changed);
        const Pairs truth = all_pairs(script.boxes(), {});
        std::array<bool, 4> right{};
        std::vector<std::thread> readers;
        readers.reserve(right.size());
        for (bool& each : right)
            readers.emplace_back([&] { each = phase.pairs() == truth; });
        for (std::thread& reader : readers)
            reader.join();
        for (const bool each : right)
            ASSERT_TRUE(each);
    }
}

TEST(BroadPhase, ManyBoxesHaveTheSamePairsForEveryMethodAndAnyThreads) {
    Random random(5006);
    for (BoxSceneKind kind : kBoxSceneKinds) {
        SCOPED_TRACE(kind.name);
        kind.hubs *= 0.05;                     // among many boxes few are hubs
        BoxScript script(random, kind, 17000); // above AutomaticSearch::kMostBoxes, 16,384
        BroadPhase tree({BroadPhaseMethod::tree, {}}), sweep({BroadPhaseMethod::sweep, {}}),
            automatic;
        std::size_t pairs = 0;
        for (int step = 0; step < 3; ++step) {
            const auto changed = script.step();
            for (BroadPhase* phase : {&tree, &automatic}) {
                set_threads(random.integer(1, 4));
                step == 0 ? phase->update(script.boxes()) : phase->update(script.boxes(), changed);
            }
            set_threads(1);
            sweep.update(script.boxes());
            // Lists of this length must not be printed by gtest on failure.
            EXPECT_TRUE(tree.pairs() == sweep.pairs());
            EXPECT_TRUE(tree.begun() == sweep.begun());
            EXPECT_TRUE(tree.ended() == sweep.ended());
            EXPECT_TRUE(automatic.pairs() == sweep.pairs());
            EXPECT_TRUE(automatic.ended() == sweep.ended());
            EXPECT_TRUE(std::is_sorted(tree.pairs().begin(), tree.pairs().end()));
            pairs += tree.pairs().size();
        }
        EXPECT_GT(pairs, 20000U);
    }
    set_threads(0);
}

TEST(BroadPhase, FindsPairsWithinAGap) {
    Random random(5004);
    std::size_t found = 0, apart = 0;
    for (int round = 0; round < many(40); ++round) {
        const BoxSceneKind& kind = kBoxSceneKinds[std::size_t(round) % kBoxSceneKinds.size()];
        const BoxScript script(random, kind, 60);
        const double gap =
            kind.lattice > 0 ? kind.lattice * random.integer(0, 3) : random.uniform(0, 0.2);
        const auto odd = [](std::uint32_t i, std::uint32_t k) { return (i + k) % 2 == 1; };
        Pairs truth;
        for (std::uint32_t i = 0; i < 60; ++i)
            for (std::uint32_t k = i + 1; k < 60; k += 2)
                if (overlap(script.boxes()[i], script.boxes()[k], gap))
                    truth.emplace_back(i, k);
        EXPECT_EQ(overlapping_boxes(script.boxes(), gap, odd), truth);
        for (const std::size_t strip : {1, 7, 16, 40})
            EXPECT_EQ(overlaps_by_strips(script.boxes(), gap, odd, strip), truth) << strip;
        found += truth.size(), apart += 900 - truth.size();
    }
    EXPECT_GT(found, 1000U);
    EXPECT_GT(apart, 1000U);
}

/// Bounds a few units in the last place from where another bound plus the gap lies, for sums of all
/// sizes, subnormal ones included.
TEST(BroadPhase, DecidesAGapExactly) {
    Random random(5007);
    int near = 0, apart = 0, rounded = 0;
    for (int round = 0; round < many(20000); ++round) {
        const auto any_double = [&] {
            const int exponent =
                random.chance(0.3) ? random.integer(-1074, -1000) : random.integer(-60, 60);
            return std::ldexp(std::round(random.uniform(0, 9)) + random.uniform(0, 1), exponent);
        };
        const double gap = any_double(), bound = random.chance(0.5) ? any_double() : -any_double();
        double lower = bound + gap;
        for (int i = random.integer(-2, 2); i != 0; i += i < 0 ? 1 : -1)
            lower = std::nextafter(lower, i < 0 ? -HUGE_VAL : HUGE_VAL);
        const double far = std::max(std::abs(lower), std::abs(bound)) + 1;
        std::vector<Box3> boxes{{{-far, -far, -far}, {far, far, far}},
                                {{-far, -far, -far}, {far, far, far}}};
        const auto set = [&](Box3& box, double from, double to, int axis) {
            (axis == 0 ? box.lower.x : axis == 1 ? box.lower.y : box.lower.z) = from;
            (axis == 0 ? box.upper.x : axis == 1 ? box.upper.y : box.upper.z) = to;
        };
        const int axis = random.integer(0, 2);
        const bool swapped = random.chance(0.5);
        set(boxes[swapped ? 1 : 0], -far, bound, axis);
        set(boxes[swapped ? 0 : 1], lower, far, axis);
        const bool expected = (Dyadic(lower) - Dyadic(bound) - Dyadic(gap)).sign() <= 0;
        ASSERT_EQ(overlapping_boxes(boxes, gap).size(), expected ? 1U : 0U)
            << std::hexfloat << lower << ' ' << bound << ' ' << gap;
        (expected ? near : apart) += 1;
        rounded += expected != (lower - bound <= gap) ? 1 : 0;
    }
    std::cout << near << " near, " << apart << " apart, " << rounded << " misjudged by rounding\n";
    EXPECT_GT(near, many(20000) / 4);
    EXPECT_GT(apart, many(20000) / 4);
    EXPECT_GT(rounded, many(20000) / 100);
}

TEST(BroadPhase, RefusesNaNAndStaysUnchanged) {
    std::vector<Box3> boxes(5, Box3{{0, 0, 0}, {1, 1, 1}});
    for (const BroadPhaseMethod method : kMethods) {
        BroadPhase phase({method, {}});
        phase.update(boxes);
        auto bad = boxes;
        bad[3].upper.y = NAN;
        try {
            phase.update(bad);
            FAIL();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument);
            EXPECT_STREQ(error.what(), "box 3 has a bound that is not a number");
        }
        EXPECT_EQ(phase.pairs().size(), 10U);
        phase.update(boxes);
        EXPECT_EQ(phase.pairs().size(), 10U);
        EXPECT_TRUE(phase.begun().empty());
    }
    EXPECT_THROW(overlapping_boxes(boxes, -1), Error);
}

TEST(BroadPhase, TakesAMillionAddsAndRemoves) {
    Random random(5005);
    std::vector<Box3> boxes(1000);
    BroadPhase phase;
    std::size_t changes = 0, pairs = 0;
    while (changes < std::size_t(many(1000000))) {
        std::vector<std::uint32_t> changed;
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            if (random.chance(0.5)) {
                const Vec3 p = random.in_cube();
                boxes[i] = boxes[i] == Box3() ? Box3{p, p + Vec3{0.1, 0.1, 0.1}} : Box3();
                changed.push_back(i);
            }
        changes += changed.size();
        phase.update(boxes, changed);
        pairs += phase.pairs().size();
    }
    EXPECT_EQ(phase.pairs(), all_pairs(boxes, {}));
    EXPECT_GT(pairs, changes / 20);
}

TEST(BroadPhase, ForgetAsksTheFilterAgain) {
    const std::vector<Box3> boxes(4, Box3{{0, 0, 0}, {1, 1, 1}});
    for (const BroadPhaseMethod method : kMethods) {
        bool none = false;
        BroadPhase phase({method, [&](std::uint32_t, std::uint32_t) { return !none; }});
        phase.update(boxes);
        phase.update(boxes);
        phase.update(boxes);
        EXPECT_EQ(phase.pairs().size(), 6U);
        none = true;
        phase.forget();
        phase.update(boxes, {});
        EXPECT_TRUE(phase.pairs().empty());
        EXPECT_EQ(phase.ended().size(), 6U);
    }
}

} // namespace
} // namespace abut::test
