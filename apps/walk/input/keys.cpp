#include "input/keys.h"

#include "input/perform.h"

#define GLFW_INCLUDE_NONE // libepoxy declares OpenGL
#include <GLFW/glfw3.h>
#include <algorithm>
#include <imgui.h>

namespace abut::viewer {

namespace {

constexpr double kRadiansOfPixel = 0.004;
constexpr double kWheelStep = 0.2;   ///< of the logarithm of the speed
constexpr double kGamepadTurn = 2.2; ///< radians a second
constexpr int kFramesOfClick = 2;

struct KeyAction {
    int key = 0;
    Action action{};
    bool repeats = false; ///< while it is held
};
constexpr KeyAction kActions[]{
    {GLFW_KEY_1, Action::walk},
    {GLFW_KEY_2, Action::fly},
    {GLFW_KEY_3, Action::orbit},
    {GLFW_KEY_F, Action::go_to_chosen},
    {GLFW_KEY_F3, Action::go_to_name},
    {GLFW_KEY_ENTER, Action::choose_ahead},
    {GLFW_KEY_H, Action::hide},
    {GLFW_KEY_U, Action::show_all},
    {GLFW_KEY_G, Action::ghosts},
    {GLFW_KEY_DELETE, Action::remove},
    {GLFW_KEY_M, Action::measure},
    {GLFW_KEY_O, Action::distances},
    {GLFW_KEY_C, Action::take},
    {GLFW_KEY_X, Action::carry_mode},
    {GLFW_KEY_LEFT, Action::turn_left, true},
    {GLFW_KEY_RIGHT, Action::turn_right, true},
    {GLFW_KEY_UP, Action::turn_up, true},
    {GLFW_KEY_DOWN, Action::turn_down, true},
    {GLFW_KEY_PAGE_UP, Action::tilt_left, true},
    {GLFW_KEY_PAGE_DOWN, Action::tilt_right, true},
    {GLFW_KEY_HOME, Action::straighten},
    {GLFW_KEY_PERIOD, Action::farther, true},
    {GLFW_KEY_COMMA, Action::nearer, true},
    {GLFW_KEY_Z, Action::move_out},
    {GLFW_KEY_T, Action::check_way},
    {GLFW_KEY_F5, Action::run_job},
    {GLFW_KEY_N, Action::next_clash},
    {GLFW_KEY_F6, Action::mark_reviewed},
    {GLFW_KEY_F7, Action::mark_approved},
    {GLFW_KEY_F8, Action::clear_mark},
    {GLFW_KEY_F9, Action::write_note},
    {GLFW_KEY_K, Action::section_plane},
    {GLFW_KEY_J, Action::section_box},
    {GLFW_KEY_V, Action::save_viewpoint},
    {GLFW_KEY_B, Action::next_viewpoint},
    {GLFW_KEY_R, Action::record},
    {GLFW_KEY_L, Action::replay},
    {GLFW_KEY_P, Action::picture},
    {GLFW_KEY_TAB, Action::panels},
    {GLFW_KEY_F1, Action::help},
    {GLFW_KEY_ESCAPE, Action::escape},
};

constexpr KeyHelp kKeyHelp[]{
    {"W A S D", "go"},
    {"E, Q", "fly: up, down"},
    {"Space, Ctrl", "walk: jump, duck"},
    {"Shift", "five times as fast"},
    {"wheel", "speed; in orbit: distance"},
    {"right drag", "look around"},
    {"click", "choose a part, or measure"},
    {"Enter", "choose the part straight ahead"},
    {"1, 2, 3", "walk, fly, orbit"},
    {"F", "go to the chosen part"},
    {"F3", "find a part by name; Enter goes there"},
    {"H, G, U", "hide it; ghosts: all others; show all"},
    {"Delete", "remove it from this walk"},
    {"M", "clicks measure: parts, point and part, points, off"},
    {"O", "colours by distance from it, or from you"},
    {"C", "take the chosen part, put it down"},
    {"X", "carry: stop, slide, through"},
    {"arrows, Page", "turn what is carried; Home: straight"},
    {". and ,", "move it away, or nearer"},
    {"Z", "move it out of what it overlaps"},
    {"T", "check the way that it was carried"},
    {"F5", "look for clashes"},
    {"N", "go to the next clash"},
    {"F6, F7, F8", "clash: reviewed, approved, no mark"},
    {"F9", "clash: write a note; Enter keeps it"},
    {"K, J", "a section plane; a section box"},
    {"V, B", "save a viewpoint; go to the next one"},
    {"R, L", "record a path; replay it"},
    {"P", "write the picture"},
    {"Tab", "panels"},
    {"F1", "these keys"},
    {"Esc", "choose nothing; twice: end"},
};

} // namespace

std::span<const KeyHelp> key_help() {
    return kKeyHelp;
}

Keys& Keys::of(GLFWwindow* window) {
    return *static_cast<Keys*>(glfwGetWindowUserPointer(window));
}

Keys::Keys(GLFWwindow* window, Session& session, Tools& tools)
    : window_(window), session_(session), tools_(tools) {
    glfwSetWindowUserPointer(window, this);
    glfwSetInputMode(window, GLFW_STICKY_KEYS, GLFW_TRUE); // a slow frame loses no short press
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
        if (action != GLFW_RELEASE && !ImGui::GetIO().WantTextInput)
            of(w).press(key, action == GLFW_REPEAT);
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
        of(w).press_button(button, action);
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).drag(x, y); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double by) {
        if (!ImGui::GetIO().WantCaptureMouse)
            of(w).scroll(by);
    });
}

ScreenPoint Keys::in_picture(double x, double y) const {
    int width = 1, height = 1;
    glfwGetWindowSize(window_, &width, &height);
    // Screens of high resolution have more pixels than mouse positions.
    return {x * session_.lens.width / std::max(1, width),
            y * session_.lens.height / std::max(1, height)};
}

void Keys::press(int key, bool is_repeated) {
    const auto* const found = std::ranges::find(kActions, key, &KeyAction::key);
    if (found == std::end(kActions) || (is_repeated && !found->repeats))
        return;
    tools_.attempt([&] { perform(found->action, session_, tools_); });
    if (tools_.must_end)
        glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Keys::press_button(int button, int action) {
    const bool is_down = action == GLFW_PRESS, on_panel = ImGui::GetIO().WantCaptureMouse;
    if (button == GLFW_MOUSE_BUTTON_RIGHT)
        looks_ = is_down && !on_panel;
    if (button != GLFW_MOUSE_BUTTON_LEFT)
        return;
    if (!is_down) {
        tools_.carrying.end_drag(session_);
        return;
    }
    if (!on_panel && tools_.carrying.begin_drag(session_, in_picture(x_, y_)))
        return;
    click_in_ = kFramesOfClick, click_x_ = x_, click_y_ = y_;
}

void Keys::drag(double x, double y) {
    if (looks_)
        session_.turn(kRadiansOfPixel * (x - x_), -kRadiansOfPixel * (y - y_));
    x_ = x, y_ = y;
    const ScreenPoint at = in_picture(x, y);
    if (tools_.carrying.drag)
        tools_.carrying.continue_drag(session_, at);
    else
        tools_.carrying.hover(session_, at);
}

void Keys::scroll(double by) {
    session_.change_speed(kWheelStep * by);
}

void Keys::click() {
    const ScreenPoint at = in_picture(click_x_, click_y_);
    const std::optional<Pick> pick = session_.pick(at.x, at.y);
    if (tools_.measure.on && pick)
        tools_.measure.take(session_, *pick);
    else if (!tools_.measure.on)
        session_.choose(pick ? std::optional(pick->part) : std::nullopt);
    session_.changed = true;
}

Wish Keys::held_keys() {
    // All keys are asked for, even if a text field gets them: asking forgets a short press.
    const auto held = [&](int key) { return glfwGetKey(window_, key) == GLFW_PRESS; };
    const auto pair = [&](int more, int less) {
        const bool is_more = held(more), is_less = held(less);
        return (is_more ? 1.0 : 0.0) - (is_less ? 1.0 : 0.0);
    };
    const auto either = [&](int a, int b) {
        const bool is_a = held(a), is_b = held(b);
        return is_a || is_b;
    };
    Wish wish;
    wish.forward = pair(GLFW_KEY_W, GLFW_KEY_S);
    wish.right = pair(GLFW_KEY_D, GLFW_KEY_A);
    wish.up = pair(GLFW_KEY_E, GLFW_KEY_Q);
    wish.fast = either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    wish.duck = either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    wish.jump = held(GLFW_KEY_SPACE);
    return ImGui::GetIO().WantTextInput ? Wish{} : wish;
}

void Keys::use_gamepad(Wish& wish, double seconds) {
    GLFWgamepadstate state;
    Gamepad now;
    for (int i = GLFW_JOYSTICK_1; i <= GLFW_JOYSTICK_LAST; ++i) {
        if (glfwGetGamepadState(i, &state) != GLFW_TRUE)
            continue;
        std::copy_n(std::begin(state.axes), now.axes.size(), now.axes.begin());
        std::ranges::transform(state.buttons, now.buttons.begin(),
                               [](unsigned char button) { return button == GLFW_PRESS; });
        break;
    }
    for (const Action action : pressed(pad_, now))
        tools_.attempt([&] { perform(action, session_, tools_); });
    pad_ = now;
    const GamepadWish asked = wish_of(now);
    const double turn = kGamepadTurn * seconds;
    if (asked.turn_right != 0 || asked.turn_up != 0)
        session_.turn(turn * asked.turn_right, turn * asked.turn_up);
    wish.forward = std::clamp(wish.forward + asked.wish.forward, -1.0, 1.0);
    wish.right = std::clamp(wish.right + asked.wish.right, -1.0, 1.0);
    wish.up = std::clamp(wish.up + asked.wish.up, -1.0, 1.0);
    wish.duck |= asked.wish.duck;
    wish.jump |= asked.wish.jump;
    wish.fast |= asked.wish.fast && session_.move == Move::walk;
}

void Keys::update(double seconds) {
    if (click_in_ > 0 && --click_in_ == 0 && !ImGui::GetIO().WantCaptureMouse)
        tools_.attempt([&] { click(); });
    Wish wish = held_keys();
    use_gamepad(wish, seconds);
    session_.step(wish, seconds);
}

} // namespace abut::viewer
