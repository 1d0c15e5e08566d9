#include "session/scene_buffer.h"

#include <epoxy/gl.h>

namespace abut::viewer {

SceneBuffer::~SceneBuffer() {
    if (framebuffer_ == 0)
        return;
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &colours_);
}

void SceneBuffer::bind(std::uint32_t width, std::uint32_t height) {
    if (framebuffer_ == 0) {
        glGenFramebuffers(1, &framebuffer_);
        glGenRenderbuffers(1, &colours_);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    if (width == width_ && height == height_)
        return;
    glBindRenderbuffer(GL_RENDERBUFFER, colours_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, static_cast<GLsizei>(width),
                          static_cast<GLsizei>(height));
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours_);
    width_ = width, height_ = height;
}

void SceneBuffer::show() const {
    const auto width = static_cast<GLint>(width_), height = static_cast<GLint>(height_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Picture SceneBuffer::read() const {
    Picture picture{width_, height_, {}};
    const std::size_t width = width_, height = height_;
    std::vector<std::uint8_t> upward(4 * width * height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), GL_RGBA,
                 GL_UNSIGNED_BYTE, upward.data());
    picture.pixels.reserve(3 * width * height);
    for (std::size_t y = height; y-- > 0;)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t k = 0; k < 3; ++k)
                picture.pixels.push_back(upward[4 * (y * width + x) + k]);
    return picture;
}

} // namespace abut::viewer
