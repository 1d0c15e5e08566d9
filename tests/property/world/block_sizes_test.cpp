// Lists whose lengths are at, just below and just above multiples of what a task or a SIMD register
// takes.

#include <abut/broad_phase.h>
#include <abut/progress.h>
#include <abut/world.h>

#include "tests/support/random.h"

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

constexpr std::array kBlockMethods{BroadPhaseMethod::automatic, BroadPhaseMethod::tree,
                                   BroadPhaseMethod::sweep, BroadPhaseMethod::sweep_and_prune};

/// Bars along x at y = i, over bars along y at x = k. Each of the first meets each of the second.
std::vector<Box3> crossing_bars(std::size_t along_x, std::size_t along_y) {
    std::vector<Box3> boxes;
    for (std::size_t i = 0; i < along_x; ++i)
        boxes.push_back({{-1, double(i), 0}, {double(along_y), double(i) + 0.5, 1}});
    for (std::size_t k = 0; k < along_y; ++k)
        boxes.push_back({{double(k), -1, 0.5}, {double(k) + 0.5, double(along_x), 1.5}});
    return boxes;
}

void move_from(std::vector<Box3>& boxes, std::size_t from, const Vec3& by) {
    for (std::size_t i = from; i < boxes.size(); ++i) {
        Box3& box = boxes[i];
        box.lower = {box.lower.x + by.x, box.lower.y + by.y, box.lower.z + by.z};
        box.upper = {box.upper.x + by.x, box.upper.y + by.y, box.upper.z + by.z};
    }
}

/// The numbers of bars whose product is the length of the list.
struct Bars {
    std::size_t along_x, along_y;
};
class BlocksOfPairs : public testing::TestWithParam<Bars> {};

TEST_P(BlocksOfPairs, PairsThatStayNeitherBeginNorEnd) {
    const auto [along_x, along_y] = GetParam();
    const std::size_t all = along_x * along_y;
    for (const BroadPhaseMethod method : kBlockMethods)
        for (const int threads : {1, 3}) {
            SCOPED_TRACE(std::string(to_string(method)) + ", threads " + std::to_string(threads));
            set_threads(threads);
            std::vector<Box3> boxes = crossing_bars(along_x, along_y);
            BroadPhase phase({method, {}});
            phase.update(boxes);
            EXPECT_EQ(phase.begun().size(), all);
            for (int step = 0; step < 4; ++step) { // the upper bars slide, and all pairs stay
                move_from(boxes, along_x, {0.1, 0.05, 0});
                phase.update(boxes);
                EXPECT_EQ(phase.pairs().size(), all);
                EXPECT_EQ(phase.begun().size(), 0U);
                EXPECT_EQ(phase.ended().size(), 0U);
            }
            boxes.back() = {{-9, -9, -9}, {-8, -8, -8}}; // one bar goes
            phase.update(boxes);
            EXPECT_EQ(phase.pairs().size(), all - along_x);
            EXPECT_EQ(phase.ended().size(), along_x);
            move_from(boxes, along_x, {0, 0, 9});
            phase.update(boxes);
            EXPECT_EQ(phase.ended().size(), all - along_x);
            EXPECT_EQ(phase.pairs().size(), 0U);
            boxes = crossing_bars(along_x, along_y);
            phase.update(boxes);
            EXPECT_EQ(phase.begun().size(), all);
        }
    set_threads(0);
}

// 16,384 is the number of pairs of a task that compares lists.
INSTANTIATE_TEST_SUITE_P(Lengths, BlocksOfPairs,
                         testing::Values(Bars{127, 129}, Bars{128, 128}, Bars{113, 145},
                                         Bars{151, 217}, Bars{128, 256}, Bars{99, 331}),
                         [](const auto& tested) {
                             return std::to_string(tested.param.along_x * tested.param.along_y);
                         });

TEST(BlockSizes, ChainsOfAnyNumberOfBoxes) {
    std::vector<std::size_t> lengths{0, 1, 2};
    for (const std::size_t block : {16, 64, 256, 1024, 4096, 16384, 65536})
        lengths.insert(lengths.end(), {block - 1, block, block + 1});
    for (const std::size_t length : lengths) {
        SCOPED_TRACE(length);
        std::vector<Box3> boxes;
        std::vector<IndexPair> chain;
        for (std::uint32_t i = 0; i < length; ++i) {
            boxes.push_back({{double(i), 0, 0}, {i + 1.25, 1, 1}});
            if (i > 0)
                chain.emplace_back(i - 1, i);
        }
        EXPECT_TRUE(overlapping_boxes(boxes) == chain);
        EXPECT_TRUE(overlapping_boxes(boxes, 0.125) == chain);
        for (const BroadPhaseMethod method : kBlockMethods) {
            SCOPED_TRACE(to_string(method));
            std::vector<Box3> moved = boxes;
            BroadPhase phase({method, {}});
            for (int step = 0; step < 3; ++step) {
                phase.update(moved);
                EXPECT_TRUE(phase.pairs() == chain);
                EXPECT_EQ(phase.begun().size(), step == 0 ? chain.size() : 0);
                EXPECT_TRUE(phase.ended().empty());
                move_from(moved, 0, {0, 0.25, 0});
            }
        }
    }
}

TEST(BlockSizes, WorldsWithAnyNumberOfPairs) {
    for (const std::size_t pairs : {1, 15, 16, 17, 31, 32, 33, 63, 64, 65, 255, 256, 257}) {
        SCOPED_TRACE(pairs);
        World world;
        std::vector<BodyMotion> motions;
        for (std::size_t i = 0; i <= pairs; ++i) {
            const BodyId id = world.add(Sphere{{double(i), 0, 0}, 0.625}, {});
            if (i % 2 == 0)
                motions.push_back({id, {{}, {}, {0, 0.125, 0}, {}}});
        }
        EXPECT_EQ(world.collide().size(), pairs);
        EXPECT_EQ(world.penetration().size(), pairs);
        EXPECT_EQ(world.within(0).size(), pairs);
        EXPECT_EQ(world.contact_manifolds().size(), pairs);
        EXPECT_EQ(world.contact_manifolds(0.125).size(), pairs);
        EXPECT_EQ(world.time_of_impact(motions).size(), pairs);
        EXPECT_EQ(world.advance(0).size(), pairs);
        EXPECT_EQ(world.begun().size(), pairs);
    }
}

} // namespace
} // namespace abut::test
