#include <abut/error.h>
#include <abut/renderer.h>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <mutex>
#include <utility>

namespace abut {

namespace {

/// The EGL display that all contexts of the process share. It is terminated with the last context,
/// because terminating it ends every context of it.
struct SharedDisplay {
    std::mutex mutex;
    EGLDisplay display = EGL_NO_DISPLAY;
    std::size_t users = 0;
};

SharedDisplay& shared_display() {
    static SharedDisplay shared;
    return shared;
}

[[noreturn]] void fail(const std::string& reason) {
    throw Error(ErrorCode::unsupported, "no picture can be drawn here: " + reason);
}

bool is_library_there(const char* name) {
    return dlopen(name, RTLD_LAZY | RTLD_LOCAL) != nullptr; // stays open: it is used at once
}

/// Throws if the libraries of the graphics driver are not installed. Without them, libepoxy would
/// end the program.
void check_libraries() {
    if (!is_library_there("libEGL.so.1"))
        fail("libEGL.so.1 is not installed");
    if (!is_library_there("libOpenGL.so.0") && !is_library_there("libGL.so.1"))
        fail("neither libOpenGL.so.0 nor libGL.so.1 is installed");
}

bool has_client_extension(const char* name) {
    return epoxy_has_egl_extension(EGL_NO_DISPLAY, name);
}

/// Returns an initialised display: without a surface if possible, else that of the window system.
EGLDisplay open_display() {
    check_libraries();
    EGLDisplay display = EGL_NO_DISPLAY;
    if (has_client_extension("EGL_MESA_platform_surfaceless") &&
        has_client_extension("EGL_EXT_platform_base")) {
        display =
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE)
            return display;
    }
    display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
        fail("EGL has no display");
    return display;
}

EGLDisplay take_display() {
    SharedDisplay& shared = shared_display();
    const std::lock_guard lock(shared.mutex);
    if (shared.users == 0)
        shared.display = open_display();
    ++shared.users;
    return shared.display;
}

void return_display() {
    SharedDisplay& shared = shared_display();
    const std::lock_guard lock(shared.mutex);
    if (--shared.users == 0)
        eglTerminate(std::exchange(shared.display, EGL_NO_DISPLAY));
}

EGLConfig choose_config(EGLDisplay display, EGLint surface_kind) {
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, surface_kind,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (eglChooseConfig(display, wanted, &config, 1, &found) != EGL_TRUE || found == 0)
        fail("EGL has no configuration for OpenGL");
    return config;
}

} // namespace

struct OffscreenContext::Handles {
    Handles() : display(take_display()) {
        try {
            create();
        } catch (...) {
            release();
            throw;
        }
    }
    ~Handles() { release(); }
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;

    void create() {
        const bool needs_surface = !epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context");
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE)
            fail("EGL has no OpenGL");
        const EGLConfig config = choose_config(display, needs_surface ? EGL_PBUFFER_BIT : 0);
        if (needs_surface) {
            const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
            surface = eglCreatePbufferSurface(display, config, size);
            if (surface == EGL_NO_SURFACE)
                fail("EGL has no surface");
        }
        const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  3,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  3,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_NONE};
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
        if (context == EGL_NO_CONTEXT)
            fail("there is no OpenGL 3.3");
        make_current();
    }
    void make_current() const {
        if (eglMakeCurrent(display, surface, surface, context) != EGL_TRUE)
            fail("EGL cannot make its context current");
    }
    void release() {
        if (context != EGL_NO_CONTEXT) {
            if (eglGetCurrentContext() == context)
                eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            eglDestroyContext(display, context);
        }
        if (surface != EGL_NO_SURFACE)
            eglDestroySurface(display, surface);
        return_display();
    }

    EGLDisplay display;
    EGLContext context = EGL_NO_CONTEXT;
    EGLSurface surface = EGL_NO_SURFACE;
};

OffscreenContext::OffscreenContext() : handles_(std::make_unique<Handles>()) {}
OffscreenContext::~OffscreenContext() = default;

void OffscreenContext::make_current() {
    handles_->make_current();
}

} // namespace abut
