#pragma once

#include "input/gamepad.h"
#include "toolbox/tools.h"

#include <span>

struct GLFWwindow;

namespace abut::viewer {

/// A line of the help: keys and what they do. The keys of an action stand once, in the table that
/// also gives them their action.
struct KeyHelp {
    const char *keys, *says;
};
/// All keys, in the order of the help.
std::span<const KeyHelp> key_help();

/// Turns keys, mouse and gamepad into wishes of the person and actions.
class Keys {
public:
    Keys(GLFWwindow* window, Session& session, Tools& tools);

    /// Moves the person by what is held down.
    void update(double seconds);

private:
    static Keys& of(GLFWwindow* window);

    void press(int key, bool is_repeated);
    void press_button(int button, int action);
    void click();
    void scroll(double by);
    void drag(double x, double y);
    [[nodiscard]] Wish held_keys();
    void use_gamepad(Wish& wish, double seconds);
    /// A position of the mouse in pixels of the picture.
    [[nodiscard]] ScreenPoint in_picture(double x, double y) const;

    GLFWwindow* window_;
    Session& session_;
    Tools& tools_;
    Gamepad pad_;          ///< in the last frame
    bool looks_ = false;   ///< the right button is down
    double x_ = 0, y_ = 0; ///< of the mouse
    /// Frames until a click counts: only the next frame knows whether it was on a panel.
    int click_in_ = 0;
    double click_x_ = 0, click_y_ = 0; ///< where it was
};

} // namespace abut::viewer
