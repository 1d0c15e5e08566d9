/// The wishes that sticks and buttons of a gamepad mean, without a gamepad.
#include "apps/walk/input/gamepad.h"

#include <gtest/gtest.h>

namespace abut::viewer {
namespace {

TEST(Gamepad, AtRestAsksForNothing) {
    const GamepadWish asked = wish_of({});
    EXPECT_EQ(asked.wish.forward, 0);
    EXPECT_EQ(asked.wish.right, 0);
    EXPECT_EQ(asked.wish.up, 0);
    EXPECT_EQ(asked.turn_right, 0);
    EXPECT_EQ(asked.turn_up, 0);
    EXPECT_FALSE(asked.wish.duck || asked.wish.jump || asked.wish.fast);
}

TEST(Gamepad, SticksGoAndLook) {
    Gamepad pad;
    pad.axes = {1, -1, -1, 1, -1, -1}; // GLFW counts right and down
    const GamepadWish asked = wish_of(pad);
    EXPECT_EQ(asked.wish.right, 1);
    EXPECT_EQ(asked.wish.forward, 1);
    EXPECT_EQ(asked.turn_right, -1);
    EXPECT_EQ(asked.turn_up, -1);
}

TEST(Gamepad, AStickNearlyAtRestIsAtRestAndGrowsFromThere) {
    double last = 0;
    for (int i = 0; i <= 100; ++i) {
        Gamepad pad;
        pad.axes[0] = static_cast<float>(i) / 100;
        const double right = wish_of(pad).wish.right;
        EXPECT_GE(right, last);
        EXPECT_EQ(right == 0, i <= 15) << i;
        last = right;
    }
    EXPECT_EQ(last, 1);
}

TEST(Gamepad, TriggersAndButtonsRiseSinkJumpAndDuck) {
    Gamepad pad;
    pad.axes[5] = 1;
    EXPECT_EQ(wish_of(pad).wish.up, 1);
    EXPECT_TRUE(wish_of(pad).wish.fast);
    pad.axes[4] = 1; // both triggers
    EXPECT_EQ(wish_of(pad).wish.up, 0);
    Gamepad a, b;
    a.buttons[0] = true;
    b.buttons[1] = true;
    EXPECT_TRUE(wish_of(a).wish.jump);
    EXPECT_EQ(wish_of(a).wish.up, 1);
    EXPECT_TRUE(wish_of(b).wish.duck);
    EXPECT_EQ(wish_of(b).wish.up, -1);
}

TEST(Gamepad, AButtonActsOnceWhenItIsPressed) {
    Gamepad up, down;
    down.buttons[2] = true;
    EXPECT_EQ(pressed(up, down), std::vector{Action::take});
    EXPECT_TRUE(pressed(down, down).empty());
    EXPECT_TRUE(pressed(down, up).empty());
    down.buttons[3] = true;
    EXPECT_EQ(pressed(up, down), (std::vector{Action::take, Action::next_clash}));
}

TEST(Gamepad, EachLineOfTheHelpSaysSomething) {
    EXPECT_GE(gamepad_help().size(), 8U);
    for (const GamepadHelp& line : gamepad_help()) {
        EXPECT_STRNE(line.control, "");
        EXPECT_STRNE(line.says, "");
    }
}

} // namespace
} // namespace abut::viewer
