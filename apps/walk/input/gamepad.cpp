#include "input/gamepad.h"

#include <algorithm>
#include <cmath>

namespace abut::viewer {

namespace {

// The numbers of GLFW, which this file does not need.
enum Axis : std::size_t { left_x, left_y, right_x, right_y, left_trigger, right_trigger };
enum Button : std::size_t {
    button_a,
    button_b,
    button_x,
    button_y,
    left_bumper,
    right_bumper,
    back,
    start,
    guide,
    left_thumb,
    right_thumb,
    pad_up,
    pad_right,
    pad_down,
    pad_left,
};

constexpr double kDeadZone = 0.15F;  ///< of a stick
constexpr double kHalfPressed = 0.5; ///< of a trigger

struct ButtonAction {
    Button button;
    Action action;
};
constexpr ButtonAction kButtons[]{
    {button_x, Action::take},
    {button_y, Action::next_clash},
    {left_bumper, Action::slower},
    {right_bumper, Action::faster},
    {back, Action::help},
    {start, Action::panels},
    {left_thumb, Action::measure},
    {right_thumb, Action::choose_ahead},
    {pad_up, Action::save_viewpoint},
    {pad_down, Action::next_viewpoint},
    {pad_left, Action::walk},
    {pad_right, Action::fly},
};

constexpr GamepadHelp kHelp[]{
    {"left stick", "go"},
    {"right stick", "look around"},
    {"A, B", "walk: jump, duck; fly: up, down"},
    {"triggers", "fly: down, up; right in walk: five times as fast"},
    {"X", "take the chosen part, put it down"},
    {"Y", "go to the next clash"},
    {"bumpers", "slower, faster"},
    {"sticks pressed", "left: measure; right: choose what is ahead"},
    {"cross", "up: save a viewpoint; down: go to the next; left: walk; right: fly"},
    {"back, start", "help; panels"},
};

/// A stick's axis without its dead zone, finer near the middle.
double stick(float value) {
    const double size = std::abs(static_cast<double>(value));
    if (!(size > kDeadZone))
        return 0;
    const double part = std::min(1.0, (size - kDeadZone) / (1 - kDeadZone));
    return std::copysign(part * part, value);
}

double trigger(float value) {
    return std::clamp((static_cast<double>(value) + 1) / 2, 0.0, 1.0);
}

} // namespace

GamepadWish wish_of(const Gamepad& pad) {
    GamepadWish asked;
    asked.wish.right = stick(pad.axes[left_x]);
    asked.wish.forward = -stick(pad.axes[left_y]);
    asked.turn_right = stick(pad.axes[right_x]);
    asked.turn_up = -stick(pad.axes[right_y]);
    const double down = trigger(pad.axes[left_trigger]), up = trigger(pad.axes[right_trigger]);
    const double by_button =
        (pad.buttons[button_a] ? 1.0 : 0.0) - (pad.buttons[button_b] ? 1.0 : 0.0);
    asked.wish.up = std::clamp(up - down + by_button, -1.0, 1.0);
    asked.wish.jump = pad.buttons[button_a];
    asked.wish.duck = pad.buttons[button_b];
    asked.wish.fast = up > kHalfPressed;
    return asked;
}

std::vector<Action> pressed(const Gamepad& before, const Gamepad& now) {
    std::vector<Action> actions;
    for (const ButtonAction& each : kButtons)
        if (now.buttons[each.button] && !before.buttons[each.button])
            actions.push_back(each.action);
    return actions;
}

std::span<const GamepadHelp> gamepad_help() {
    return kHelp;
}

} // namespace abut::viewer
