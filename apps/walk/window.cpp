#include "window.h"

#include <abut/error.h>

#include "input/keys.h"
#include "open_model.h"
#include "panels/panels.h"
#include "session/scene_buffer.h"
#include "session/session.h"
#include "toolbox/background_task.h"
#include "toolbox/event_log.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE // libepoxy has declared OpenGL
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <cstdio>
#include <imgui.h>
#include <stdexcept>

namespace abut::viewer {

namespace {

/// Seconds without a change after which the picture is made complete.
constexpr double kRest = 0.3;
constexpr double kIdle = 0.1;       ///< seconds between the frames of a window at rest
constexpr double kLongFrame = 0.25; ///< seconds; a longer frame moves the person no farther
constexpr double kSmoothing = 0.9;  ///< of the shown milliseconds of a frame
constexpr float kPanelLeft = 10, kPanelWidth = 320, kPanelBelow = 50; ///< pixels

/// Throws with the reason that GLFW gives.
///
/// In          needs: what is missing, as far as this program knows.
[[noreturn]] void fail_to_open(const char* needs) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw Error(ErrorCode::unsupported, std::string("no window can be opened: ") + needs +
                                            (reason != nullptr ? std::string(": ") + reason : ""));
}

/// The window and its context, with Dear ImGui.
class Screen {
public:
    Screen(std::uint32_t width, std::uint32_t height) {
        if (glfwInit() != GLFW_TRUE)
            fail_to_open("it needs a display (--path and --frames need none)");
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        window = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), "abut-walk",
                                  nullptr, nullptr);
        if (window == nullptr) {
            try {
                fail_to_open("it needs OpenGL 3.3");
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
    void attach() const {
        ImGui_ImplGlfw_InitForOpenGL(window, true);
        ImGui_ImplOpenGL3_Init("#version 330");
    }
    /// Before other callbacks are set.
    static void detach() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
    }
    static void begin_panels() {
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
    }
    static void draw_panels(std::uint32_t width, std::uint32_t height) {
        ImGui::Render();
        glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    }
    ~Screen() {
        if (ImGui::GetIO().BackendRendererUserData != nullptr)
            detach();
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
    Loop(GLFWwindow* window, Session& session, const Arguments& arguments)
        : window_(window), session_(session), keys_(window, session, tools_), log_(arguments.log) {
        tools_.attempt([&] { tools_.viewpoints.open(session.path); });
        if (!arguments.part.empty())
            begin_at(arguments.part);
        if (!arguments.carry.empty())
            tools_.carrying.bring_in(arguments.carry);
    }

    void run() {
        double last = glfwGetTime();
        while (glfwWindowShouldClose(window_) == GLFW_FALSE) {
            // A picture that is complete waits for input, and costs nothing.
            if (is_complete_)
                glfwWaitEventsTimeout(kIdle);
            else
                glfwPollEvents();
            const double now = glfwGetTime(), seconds = std::min(now - last, kLongFrame);
            last = now;
            frame(now, seconds);
        }
    }

private:
    void begin_at(const std::string& name) {
        const std::optional<std::uint32_t> part = session_.find(name);
        if (!part)
            throw Error(ErrorCode::bad_argument, "--part",
                        "no part has the id or the name '" + name + "'");
        session_.choose(*part);
        session_.look_at(session_.box_of(*part));
    }

    void frame(double now, double seconds) {
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        if (width < 1 || height < 1)
            return;
        if (session_.lens.width != static_cast<std::uint32_t>(width) ||
            session_.lens.height != static_cast<std::uint32_t>(height))
            session_.resize(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
        keys_.update(seconds);
        tools_.update(session_, seconds);
        draw_scene(now, seconds);
        draw_panels();
        glfwSwapBuffers(window_);
        log_.write(session_, tools_, is_complete_, now);
        tools_.frame_milliseconds =
            kSmoothing * tools_.frame_milliseconds + (1 - kSmoothing) * 1000 * seconds;
    }

    void draw_scene(double now, double seconds) {
        const Camera camera = session_.camera();
        const Vec3 velocity = seconds > 0 ? (1 / seconds) * (camera.eye - eye_) : Vec3{};
        const bool moves = !(camera.eye == eye_ && camera.forward == forward_) || session_.changed;
        if (moves) {
            last_change_ = now;
            tools_.attempt([&] { tools_.proximity.update(session_); });
            tools_.attempt([&] { tools_.proximity.colour(session_); });
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
        Screen::begin_panels();
        show_gizmo(session_, tools_);
        if (tools_.with_panels)
            show_panels();
        show_help_panel(tools_);
        show_distance_legend(session_);
        show_status_line(session_, tools_);
        tools_.is_typing = ImGui::GetIO().WantTextInput;
        Screen::draw_panels(session_.lens.width, session_.lens.height);
    }

    void show_panels() {
        ImGui::SetNextWindowPos(ImVec2(kPanelLeft, kPanelLeft), ImGuiCond_FirstUseEver);
        ImGui::SetNextWindowSize(ImVec2(kPanelWidth, ImGui::GetIO().DisplaySize.y - kPanelBelow),
                                 ImGuiCond_FirstUseEver);
        ImGui::Begin("Abut");
        show_parts_panel(session_, tools_);
        show_proximity_panel(session_, tools_);
        show_measure_panel(session_, tools_);
        tools_.attempt([&] { show_colour_panel(session_); });
        show_section_panel(session_, tools_);
        show_clash_panel(session_, tools_);
        show_carry_panel(session_, tools_);
        show_viewpoint_panel(session_, tools_);
        ImGui::End();
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

/// Prepares the store, with its progress in the window. Returns no path if the window was closed.
std::optional<std::string> prepare(const Screen& screen, const Arguments& arguments) {
    BackgroundTask task;
    std::string store;
    screen.attach();
    task.start([&](const Progress& progress) {
        const Progress terminal = terminal_progress(arguments.quiet);
        const auto report = [&](std::string_view stage, double fraction) {
            progress.report(stage, fraction);
            if (terminal.report)
                terminal.report(stage, fraction);
        };
        store = ready_store(arguments.files, {report, progress.stop});
    });
    while (!task.has_ended()) {
        glfwWaitEventsTimeout(kIdle);
        if (glfwWindowShouldClose(screen.window) == GLFW_TRUE ||
            glfwGetKey(screen.window, GLFW_KEY_ESCAPE) == GLFW_PRESS)
            task.stop();
        int width = 0, height = 0;
        glfwGetFramebufferSize(screen.window, &width, &height);
        glClearColor(0.93F, 0.94F, 0.95F, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        Screen::begin_panels();
        show_import(task.stage(), task.fraction());
        Screen::draw_panels(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
        glfwSwapBuffers(screen.window);
    }
    Screen::detach();
    if (task.was_interrupted())
        return std::nullopt;
    if (!task.error().empty())
        throw std::runtime_error(task.error());
    return store;
}

} // namespace

void show_window(const Arguments& arguments) {
    // The window comes first: without a display nothing is imported.
    const Screen screen(arguments.width, arguments.height);
    const std::optional<std::string> store = prepare(screen, arguments);
    if (!store) {
        if (!arguments.quiet)
            std::puts("closed while the model was prepared; the next start goes on from there");
        return;
    }
    Session session(*store, {arguments.memory, arguments.gpu_memory, arguments.pixel_error},
                    arguments.width, arguments.height);
    Loop loop(screen.window, session, arguments);
    screen.attach();
    loop.run();
}

} // namespace abut::viewer
