#pragma once

#include <epoxy/gl.h>
#include <utility>

namespace abut {

/// Owns an object of the current OpenGL context. The context must be current when it is destroyed.
template <typename Kind>
class GlHandle {
public:
    GlHandle() { Kind::create(&name_); }
    ~GlHandle() {
        if (name_ != 0)
            Kind::destroy(&name_);
    }
    GlHandle(GlHandle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlHandle& operator=(GlHandle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    GlHandle(const GlHandle&) = delete;
    GlHandle& operator=(const GlHandle&) = delete;

    [[nodiscard]] GLuint name() const { return name_; }

private:
    GLuint name_ = 0;
};

struct GlBufferKind {
    static void create(GLuint* name) { glGenBuffers(1, name); }
    static void destroy(const GLuint* name) { glDeleteBuffers(1, name); }
};
struct GlTextureKind {
    static void create(GLuint* name) { glGenTextures(1, name); }
    static void destroy(const GLuint* name) { glDeleteTextures(1, name); }
};
struct GlVertexArrayKind {
    static void create(GLuint* name) { glGenVertexArrays(1, name); }
    static void destroy(const GLuint* name) { glDeleteVertexArrays(1, name); }
};
struct GlFramebufferKind {
    static void create(GLuint* name) { glGenFramebuffers(1, name); }
    static void destroy(const GLuint* name) { glDeleteFramebuffers(1, name); }
};

using GlBuffer = GlHandle<GlBufferKind>;
using GlTexture = GlHandle<GlTextureKind>;
using GlVertexArray = GlHandle<GlVertexArrayKind>;
using GlFramebuffer = GlHandle<GlFramebufferKind>;

} // namespace abut
