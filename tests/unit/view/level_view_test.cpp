// A view of a wall and a thing behind it.
#include "view/level_view.h"

#include <gtest/gtest.h>
#include <vector>

namespace abut::test {
namespace {

/// A chunk of one rectangle at depth y.
ViewChunk rectangle(float half, float y, std::uint32_t part) {
    ViewChunk chunk;
    chunk.lower = {-half, y, -half};
    chunk.step = {2 * half / 65535, 0, 2 * half / 65535};
    for (const auto& [x, z] : {std::pair(0, 0), {65535, 0}, {65535, 65535}, {0, 65535}})
        chunk.vertices.push_back(
            {{static_cast<std::uint16_t>(x), 0, static_cast<std::uint16_t>(z)}, {}, part});
    chunk.indices = {0, 1, 2, 0, 2, 3};
    return chunk;
}

class WallAndThing : public testing::Test {
protected:
    WallAndThing() {
        chunks_ = {rectangle(20, 5, 0), rectangle(20, 5, 0), rectangle(1, 10, 1)};
        tree_.nodes = {{{-20, 5, -20}, {20, 10, 20}, 5, 0, 1, 2},
                       {{-20, 5, -20}, {20, 5, 20}, 0, 1},
                       {{-1, 10, -1}, {1, 10, 1}, 0, 2}};
        tree_.chunks = {{2, 4}, {2, 4}, {2, 4}};
        tree_.parts = {7, 8};
    }
    LevelView view() {
        ViewOptions options;
        options.background = false;
        return {tree_, [this](std::uint32_t chunk) { return chunks_[chunk]; }, "store", options};
    }
    static std::vector<std::uint32_t> drawn(LevelView& view) {
        const CameraMotion motion{Camera{}, {}, {}}; // at the origin, along y
        (void)view.frame(motion);
        std::vector<std::uint32_t> chunks;
        for (const ChunkDraw& draw : view.frame(motion).draws)
            chunks.push_back(draw.chunk);
        return chunks;
    }

    LevelTree tree_;
    std::vector<ViewChunk> chunks_;
};

TEST_F(WallAndThing, TheWallHidesTheThing) {
    LevelView view = this->view();
    EXPECT_EQ(drawn(view), std::vector<std::uint32_t>{1});
    EXPECT_EQ(view.statistics().culled_by_occlusion, 1U);
}

TEST_F(WallAndThing, NotIfTheWallIsHidden) {
    LevelView view = this->view();
    view.set_hidden(0, true);
    EXPECT_EQ(drawn(view), (std::vector<std::uint32_t>{1, 2})); // nearest first
    view.set_hidden(0, false);
    EXPECT_EQ(drawn(view), std::vector<std::uint32_t>{1});
}

TEST_F(WallAndThing, NotIfOcclusionIsOff) {
    LevelView view = this->view();
    view.set_occlusion(false);
    EXPECT_EQ(drawn(view), (std::vector<std::uint32_t>{1, 2}));
}

TEST_F(WallAndThing, NotIfItStandsOut) {
    chunks_[2] = rectangle(25, 8, 1);
    tree_.nodes[2].lower = {-25, 8, -25}, tree_.nodes[2].upper = {25, 8, 25};
    for (std::size_t node : {0, 1}) // a smaller wall
        tree_.nodes[node].lower[0] = node == 0 ? -25 : -1;
    chunks_[1] = rectangle(1, 5, 0);
    LevelView view = this->view();
    EXPECT_EQ(drawn(view), (std::vector<std::uint32_t>{1, 2}));
}

} // namespace
} // namespace abut::test
