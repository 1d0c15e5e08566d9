#pragma once

#include "tools.h"

struct GLFWwindow;

namespace abut::viewer {

/// Turns keys and mouse into wishes of the person and calls of the tools.
class Keys {
public:
    Keys(GLFWwindow* window, Session& session, Tools& tools);

    /// Moves the person by what is held down.
    void update(double seconds);

private:
    static Keys& of(GLFWwindow* window);

    void press(int key);
    void press_part_key(int key);
    void write_picture();
    void click();
    void scroll(double by);
    void drag(double x, double y);

    GLFWwindow* window_;
    Session& session_;
    Tools& tools_;
    bool looks_ = false;   ///< the right button is down
    double x_ = 0, y_ = 0; ///< of the mouse
    int pictures_ = 0;     ///< written
    /// Frames until a click counts: only the next frame knows whether it was on a panel.
    int click_in_ = 0;
    double click_x_ = 0, click_y_ = 0; ///< where it was
};

} // namespace abut::viewer
