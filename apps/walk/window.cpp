#include "window.h"

#include <abut/error.h>

#include "event_log.h"
#include "keys.h"
#include "open_model.h"
#include "panels/panels.h"
#include "scene_buffer.h"
#include "session.h"
#include "vec.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE // libepoxy has declared OpenGL
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace abut::viewer {

namespace {

/// Seconds without a change after which the picture is made complete.
constexpr double kRest = 0.3;

[[noreturn]] void fail_to_open() {
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw Error(ErrorCode::unsupported, std::string("no window can be opened: ") +
                                            (reason != nullptr ? reason : "there is no display") +
                                            " (--path and --frames need none)");
}

/// The window and its context, with Dear ImGui.
class Screen {
public:
    Screen(std::uint32_t width, std::uint32_t height) {
        if (glfwInit() != GLFW_TRUE)
            fail_to_open();
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        window = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), "abut-walk",
                                  nullptr, nullptr);
        if (window == nullptr) {
            try {
                fail_to_open();
            } catch (...) {
                glfwTerminate();
                throw;
            }
        }
        glfwMakeContextCurrent(window);
        glfwSwapInterval(1);
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        ImGui::StyleColorsLight();
        ImGui::GetStyle().WindowRounding = 4;
    }
    /// Dear ImGui calls the callbacks that were set before, so it comes after ours.
    static void attach(GLFWwindow* window) {
        ImGui_ImplGlfw_InitForOpenGL(window, true);
        ImGui_ImplOpenGL3_Init("#version 330");
    }
    ~Screen() {
        if (ImGui::GetIO().BackendRendererUserData != nullptr) {
            ImGui_ImplOpenGL3_Shutdown();
            ImGui_ImplGlfw_Shutdown();
        }
        ImGui::DestroyContext();
        glfwDestroyWindow(window);
        glfwTerminate();
    }
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    GLFWwindow* window = nullptr;
};

/// The frames of the window.
class Loop {
public:
    Loop(GLFWwindow* window, Session& session, const std::string& log)
        : window_(window), session_(session), keys_(window, session, tools_), log_(log) {}

    void run() {
        double last = glfwGetTime();
        while (glfwWindowShouldClose(window_) == GLFW_FALSE) {
            // A picture that is complete waits for input, and costs nothing.
            if (is_complete_)
                glfwWaitEventsTimeout(0.1);
            else
                glfwPollEvents();
            const double now = glfwGetTime(), seconds = std::min(now - last, 0.25);
            last = now;
            frame(now, seconds);
        }
    }

private:
    void frame(double now, double seconds) {
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        if (width < 1 || height < 1)
            return;
        if (session_.lens.width != static_cast<std::uint32_t>(width) ||
            session_.lens.height != static_cast<std::uint32_t>(height))
            session_.resize(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
        keys_.update(seconds);
        tools_.attempt([&] { tools_.viewpoints.update(session_, seconds); });
        tools_.attempt([&] { tools_.carrying.update(session_); });
        tools_.attempt([&] { tools_.clashes.update(session_); });
        draw_scene(now, seconds);
        draw_panels();
        glfwSwapBuffers(window_);
        log_.write(session_, tools_, is_complete_, now);
        tools_.frame_milliseconds = 0.9 * tools_.frame_milliseconds + 100 * seconds;
    }

    void draw_scene(double now, double seconds) {
        const Camera camera = session_.camera();
        const Vec3 velocity = seconds > 0 ? (1 / seconds) * (camera.eye - eye_) : Vec3{};
        const bool moves = !(camera.eye == eye_ && camera.forward == forward_) || session_.changed;
        if (moves) {
            last_change_ = now;
            tools_.attempt([&] { tools_.proximity.update(session_); });
        }
        eye_ = camera.eye, forward_ = camera.forward;
        session_.changed = false;
        const bool rests = now - last_change_ > kRest;
        if (is_complete_ && !moves)
            return;
        if (!rests && moves && was_moving_)
            session_.pace.add_frame(seconds);
        was_moving_ = moves && !rests;
        const ViewFrame& frame = session_.frame(camera, velocity, rests);
        const bool is_final = rests && frame.loaded;
        session_.marks.clear();
        tools_.add_marks(session_);
        scene_.bind(camera.width, camera.height);
        session_.renderer.draw(frame, camera, session_.style(is_final), session_.marks);
        if (is_final)
            tools_.attempt([&] { tools_.proximity.update(session_); }); // all has been read now
        is_complete_ = is_final;
    }

    void draw_panels() {
        scene_.show();
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        if (tools_.with_panels) {
            ImGui::SetNextWindowPos(ImVec2(10, 10), ImGuiCond_FirstUseEver);
            ImGui::SetNextWindowSize(ImVec2(320, ImGui::GetIO().DisplaySize.y - 50),
                                     ImGuiCond_FirstUseEver);
            ImGui::Begin("Abut");
            show_parts_panel(session_, tools_);
            show_proximity_panel(session_, tools_);
            show_measure_panel(session_, tools_);
            show_section_panel(session_);
            show_clash_panel(session_, tools_);
            show_carry_panel(session_, tools_);
            show_viewpoint_panel(session_, tools_);
            ImGui::End();
        }
        show_help_panel(tools_);
        show_status_line(session_, tools_);
        ImGui::Render();
        glViewport(0, 0, static_cast<GLsizei>(session_.lens.width),
                   static_cast<GLsizei>(session_.lens.height));
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    }

    GLFWwindow* window_;
    Session& session_;
    Tools tools_;
    Keys keys_;
    EventLog log_;
    SceneBuffer scene_;
    Vec3 eye_, forward_;
    double last_change_ = 0;
    bool is_complete_ = false, was_moving_ = false;
};

} // namespace

void show_window(const Arguments& arguments) {
    // The window comes first: without a display nothing is imported.
    const Screen screen(arguments.width, arguments.height);
    const std::string store = ready_store(arguments.files, arguments.quiet);
    Session session(store, {arguments.memory, arguments.gpu_memory, arguments.pixel_error},
                    arguments.width, arguments.height);
    Loop loop(screen.window, session, arguments.log);
    Screen::attach(screen.window);
    loop.run();
}

} // namespace abut::viewer
