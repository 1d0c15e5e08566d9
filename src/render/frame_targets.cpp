#include "render/frame_targets.h"

#include <abut/error.h>

#include <algorithm>

namespace abut {

namespace {

struct PixelLayout {
    GLenum format, type;
};

PixelLayout layout_of(GLenum internal) {
    switch (internal) {
    case GL_RG32UI:
        return {GL_RG_INTEGER, GL_UNSIGNED_INT};
    case GL_DEPTH_COMPONENT32F:
        return {GL_DEPTH_COMPONENT, GL_FLOAT};
    case GL_R32F:
        return {GL_RED, GL_FLOAT};
    case GL_RG16F:
        return {GL_RG, GL_FLOAT};
    case GL_R8:
        return {GL_RED, GL_UNSIGNED_BYTE};
    default:
        return {GL_RGBA, GL_UNSIGNED_BYTE};
    }
}

} // namespace

RenderTarget::RenderTarget(std::uint32_t width, std::uint32_t height,
                           std::initializer_list<GLenum> formats, GLuint depth)
    : width_(width), height_(height) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (std::max(width, height) > static_cast<std::uint32_t>(most))
        throw Error(ErrorCode::bad_argument,
                    "a picture can have at most " + std::to_string(most) + " samples a side");
    // A unit that no pass uses, so that their bindings stay.
    glActiveTexture(GL_TEXTURE15);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    std::size_t index = 0;
    for (const GLenum format : formats) {
        const PixelLayout layout = layout_of(format);
        const GLuint name = textures_[index++].name();
        glBindTexture(GL_TEXTURE_2D, name);
        glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), static_cast<GLsizei>(width),
                     static_cast<GLsizei>(height), 0, layout.format, layout.type, nullptr);
        for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
        const bool is_depth = layout.format == GL_DEPTH_COMPONENT;
        glFramebufferTexture2D(GL_FRAMEBUFFER,
                               is_depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                               name, 0);
    }
    if (depth != 0)
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error(ErrorCode::unsupported, "OpenGL refuses the buffers of a picture of " +
                                                std::to_string(width) + " x " +
                                                std::to_string(height) + " samples");
}

void RenderTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
}

void RenderTarget::bind_texture(std::size_t index, GLuint unit) const {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, textures_[index].name());
}

void FrameTargets::resize(std::uint32_t width, std::uint32_t height, std::uint32_t samples) {
    if (parts_ && width == width_ && height == height_ && samples == samples_)
        return;
    *this = {};
    parts_ = std::make_unique<RenderTarget>(
        width * samples, height * samples,
        std::initializer_list<GLenum>{GL_RG32UI, GL_DEPTH_COMPONENT32F});
    width_ = width, height_ = height, samples_ = samples;
}

namespace {

const RenderTarget& made(std::unique_ptr<RenderTarget>& held, std::uint32_t width,
                         std::uint32_t height, GLenum format, GLuint depth = 0) {
    if (!held)
        held = std::make_unique<RenderTarget>(width, height, std::initializer_list<GLenum>{format},
                                              depth);
    return *held;
}

} // namespace

const RenderTarget& FrameTargets::ghosts() {
    return made(ghosts_, width_ * samples_, height_ * samples_, GL_RGBA8, parts_->texture(1));
}
const RenderTarget& FrameTargets::colours() {
    return made(colours_, width_ * samples_, height_ * samples_, GL_RGBA8);
}
const RenderTarget& FrameTargets::half() {
    return made(half_, width_ * samples_ / 2, height_ * samples_ / 2, GL_RGBA8);
}
const RenderTarget& FrameTargets::occlusion() {
    return made(occlusion_, width_, height_, GL_RG16F);
}
const RenderTarget& FrameTargets::smooth() {
    return made(smooth_, width_, height_, GL_R8);
}
const RenderTarget& FrameTargets::picture() {
    return made(picture_, width_, height_, GL_RGBA8);
}

} // namespace abut
