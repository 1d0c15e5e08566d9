/// The triangles of a frame: how they follow the machine, and what is hidden.
#include "apps/walk/frame_pace.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

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

TEST(FramePace, LeavesOutLinesOfASlowMachine) {
    FramePace pace;
    EXPECT_TRUE(pace.with_lines());
    for (int i = 0; i < 6; ++i)
        pace.add_frame(1);
    EXPECT_GT(pace.triangles(), 250'000U);
    EXPECT_TRUE(pace.with_lines()); // as long as enough triangles are drawn
    pace.add_frame(1);
    EXPECT_LT(pace.triangles(), 250'000U);
    EXPECT_FALSE(pace.with_lines());
    for (int i = 0; i < 160; ++i)
        pace.add_frame(0.01);
    EXPECT_EQ(pace.triangles(), 500'000U);
    EXPECT_FALSE(pace.with_lines()); // they do not come and go
    for (int i = 0; i < 10; ++i)
        pace.add_frame(0.01);
    EXPECT_TRUE(pace.with_lines());
}

/// The median of the frames of a machine, once the pace knows it.
///
/// In          fixed: seconds of a frame without triangles; triangle: seconds of one; slow_every: so
///             many frames, one takes four times as long, as something else is busy.
double median_frame(double fixed, double triangle, int slow_every) {
    FramePace pace;
    std::vector<double> seconds;
    for (int i = 0; i < 600; ++i) {
        double frame = fixed + triangle * static_cast<double>(pace.triangles());
        if (i % slow_every == slow_every - 1)
            frame *= 4;
        pace.add_frame(frame);
        if (i >= 100)
            seconds.push_back(frame);
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
}

TEST(FramePace, KeepsFifteenFramesASecondOnSlowMachines) {
    for (const double triangle : {1.2e-7, 1.5e-7, 3e-7, 5e-7})
        for (const int slow_every : {1'000, 50, 10}) {
            const double median = median_frame(0.005, triangle, slow_every);
            EXPECT_LE(median, 1.0 / 15) << triangle << ", one slow frame in " << slow_every;
            EXPECT_GE(median, 0.6 / 15) << triangle << ", one slow frame in " << slow_every;
        }
    EXPECT_GT(median_frame(0.005, 1e-6, 1'000), 1.0 / 15) << "too slow for the least budget";
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
