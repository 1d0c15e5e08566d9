/// The triangles of a frame: how they follow the machine, and what is hidden.
#include "apps/walk/frame_pace.h"

#include <gtest/gtest.h>

namespace abut::viewer {
namespace {

TEST(FramePace, FollowsTheMachineSlowly) {
    FramePace pace;
    EXPECT_EQ(pace.triangles(), 500'000U);
    pace.add_frame(10); // one slow frame
    EXPECT_EQ(pace.triangles(), 450'000U);
    pace.add_frame(0);
    EXPECT_EQ(pace.triangles(), 450'000U);
    for (int i = 0; i < 100; ++i)
        pace.add_frame(0.2);
    EXPECT_EQ(pace.triangles(), 100'000U);
    for (int i = 0; i < 100; ++i)
        pace.add_frame(0.01);
    EXPECT_EQ(pace.triangles(), 500'000U);
}

TEST(FramePace, ChoosesMoreWhereMuchIsHidden) {
    FramePace pace;
    for (int i = 0; i < 7; ++i)
        pace.add_hidden(200'000);
    EXPECT_EQ(pace.chosen(), 500'000U) << "one picture may show all";
    pace.add_hidden(120'000);
    EXPECT_EQ(pace.chosen(), 527'500U) << "three quarters of the least, less an eighth of all";
    for (int i = 0; i < 8; ++i)
        pace.add_hidden(5'000'000);
    EXPECT_EQ(pace.chosen(), 1'000'000U) << "at most twice as many";
    pace.add_hidden(0);
    EXPECT_EQ(pace.chosen(), 500'000U);
    for (int i = 0; i < 8; ++i)
        pace.add_hidden(100'000);
    EXPECT_EQ(pace.chosen(), 512'500U);
    pace.forget_hidden();
    EXPECT_EQ(pace.chosen(), 500'000U);
}

} // namespace
} // namespace abut::viewer
