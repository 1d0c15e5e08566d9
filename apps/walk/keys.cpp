#include "keys.h"

#include "vec.h"

#include <fmt/format.h>
#define GLFW_INCLUDE_NONE // libepoxy declares OpenGL
#include <GLFW/glfw3.h>
#include <imgui.h>

namespace abut::viewer {

Keys& Keys::of(GLFWwindow* window) {
    return *static_cast<Keys*>(glfwGetWindowUserPointer(window));
}

Keys::Keys(GLFWwindow* window, Session& session, Tools& tools)
    : window_(window), session_(session), tools_(tools) {
    glfwSetWindowUserPointer(window, this);
    glfwSetInputMode(window, GLFW_STICKY_KEYS, GLFW_TRUE); // a slow frame loses no short press
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
        if (action == GLFW_PRESS && !ImGui::GetIO().WantTextInput)
            of(w).tools_.attempt([&] { of(w).press(key); });
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
        Keys& keys = of(w);
        if (button == GLFW_MOUSE_BUTTON_RIGHT)
            keys.looks_ = action == GLFW_PRESS && !ImGui::GetIO().WantCaptureMouse;
        if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS)
            keys.click_in_ = 2, keys.click_x_ = keys.x_, keys.click_y_ = keys.y_;
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).drag(x, y); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double by) {
        if (!ImGui::GetIO().WantCaptureMouse)
            of(w).scroll(by);
    });
}

void Keys::drag(double x, double y) {
    if (looks_)
        session_.turn(0.004 * (x - x_), -0.004 * (y - y_));
    x_ = x, y_ = y;
}

void Keys::scroll(double by) {
    if (session_.move == Move::orbit)
        session_.orbit_distance =
            std::clamp(session_.orbit_distance * std::exp(-0.1 * by), 0.05, session_.lens.far);
    else
        session_.speed = std::clamp(session_.speed * std::exp(0.2 * by), 0.05, 200.0);
}

void Keys::click() {
    int width = 1, height = 1;
    glfwGetWindowSize(window_, &width, &height);
    // Screens of high resolution have more pixels than mouse positions.
    const std::optional<Pick> pick =
        session_.pick(click_x_ * session_.lens.width / std::max(1, width),
                      click_y_ * session_.lens.height / std::max(1, height));
    if (tools_.measure.on && pick)
        tools_.measure.take(session_, *pick);
    else if (!tools_.measure.on)
        session_.choose(pick ? std::optional(pick->part) : std::nullopt);
    session_.changed = true;
}

void Keys::press_part_key(int key) {
    if (key == GLFW_KEY_U) {
        for (std::uint32_t i = 0; i < session_.view.parts().size(); ++i) {
            PartState state = session_.state(i);
            const bool is_plain = !state.hidden && !state.ghosted;
            if (is_plain && state.colour == session_.colour_of(i))
                continue;
            state.hidden = state.ghosted = false;
            state.colour = session_.colour_of(i);
            session_.set_state(i, state);
        }
        return;
    }
    if (key == GLFW_KEY_C && tools_.carrying.carry) {
        tools_.carrying.put_down(session_);
        return;
    }
    if (!session_.chosen)
        return;
    const std::uint32_t chosen = *session_.chosen;
    if (key == GLFW_KEY_F)
        session_.look_at(session_.box_of(chosen));
    if (key == GLFW_KEY_G)
        session_.ghost_all_but({chosen});
    if (key == GLFW_KEY_C)
        tools_.carrying.take(session_, chosen);
    if (key == GLFW_KEY_H) {
        PartState state = session_.state(chosen);
        state.hidden = true;
        session_.set_state(chosen, state);
    }
}

void Keys::write_picture() {
    const Camera camera = session_.camera();
    const ViewFrame& frame = session_.frame(camera);
    const std::string name = fmt::format("abut-walk-{}.png", ++pictures_);
    write_png(session_.renderer.picture(frame, camera, session_.style(true), session_.marks), name);
    tools_.message = name + " written";
}

void Keys::press(int key) {
    switch (key) {
    case GLFW_KEY_1:
        session_.set_move(Move::walk);
        break;
    case GLFW_KEY_2:
        session_.set_move(Move::fly);
        break;
    case GLFW_KEY_3:
        session_.set_move(Move::orbit);
        break;
    case GLFW_KEY_M:
        tools_.measure.on = !tools_.measure.on;
        break;
    case GLFW_KEY_R:
        tools_.viewpoints.toggle_recording();
        break;
    case GLFW_KEY_L:
        tools_.viewpoints.replay();
        break;
    case GLFW_KEY_V:
        tools_.viewpoints.save(session_);
        break;
    case GLFW_KEY_B:
        tools_.viewpoints.visit_next(session_);
        break;
    case GLFW_KEY_N:
        tools_.clashes.show_next(session_);
        break;
    case GLFW_KEY_K:
        session_.add_plane();
        break;
    case GLFW_KEY_X: {
        CarryMode& mode = tools_.carrying.mode;
        mode = mode == CarryMode::stop    ? CarryMode::slide
               : mode == CarryMode::slide ? CarryMode::through
                                          : CarryMode::stop;
        break;
    }
    case GLFW_KEY_P:
        write_picture();
        break;
    case GLFW_KEY_TAB:
        tools_.with_panels = !tools_.with_panels;
        break;
    case GLFW_KEY_F1:
        tools_.with_help = !tools_.with_help;
        break;
    case GLFW_KEY_ESCAPE:
        if (!session_.chosen)
            glfwSetWindowShouldClose(window_, GLFW_TRUE);
        session_.choose(std::nullopt);
        break;
    default:
        press_part_key(key);
    }
    session_.changed = true;
}

void Keys::update(double seconds) {
    if (click_in_ > 0 && --click_in_ == 0 && !ImGui::GetIO().WantCaptureMouse)
        tools_.attempt([&] { click(); });
    // All keys are asked for, even if a text field gets them: asking forgets a short press.
    const auto held = [&](int key) { return glfwGetKey(window_, key) == GLFW_PRESS; };
    const auto axis = [&](int more, int less) {
        return (held(more) ? 1.0 : 0.0) - (held(less) ? 1.0 : 0.0);
    };
    const auto either = [&](int a, int b) {
        const bool is_a = held(a), is_b = held(b);
        return is_a || is_b;
    };
    Wish wish;
    wish.forward = axis(GLFW_KEY_W, GLFW_KEY_S);
    wish.right = axis(GLFW_KEY_D, GLFW_KEY_A);
    wish.up = axis(GLFW_KEY_E, GLFW_KEY_Q);
    wish.fast = either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    wish.duck = either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    wish.jump = held(GLFW_KEY_SPACE);
    if (ImGui::GetIO().WantTextInput)
        wish = {};
    session_.step(wish, seconds);
}

} // namespace abut::viewer
