#pragma once

#include "input/action.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace abut::viewer {

/// The state of a gamepad, in the order of GLFW: an axis of a stick lies in [-1, 1], right and
/// down; a trigger is -1 where it is released.
struct Gamepad {
    std::array<float, 6> axes{0, 0, 0, 0, -1, -1};
    std::array<bool, 15> buttons{};
};

/// Turns the sticks and triggers of a gamepad into the wishes of a frame.
struct GamepadWish {
    Wish wish;
    double turn_right = 0, turn_up = 0; ///< in [-1, 1], of the fastest turn
};

/// Sticks that are nearly at rest count as at rest.
GamepadWish wish_of(const Gamepad& pad);

/// The actions of the buttons that were pressed between two states.
std::vector<Action> pressed(const Gamepad& before, const Gamepad& now);

/// A line of the help.
struct GamepadHelp {
    const char *control, *says;
};
std::span<const GamepadHelp> gamepad_help();

} // namespace abut::viewer
