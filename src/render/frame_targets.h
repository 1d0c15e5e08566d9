#pragma once

#include "render/gl_handle.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>

namespace abut {

/// A framebuffer with textures of one size.
class RenderTarget {
public:
    /// In          formats: of the textures; a depth format is attached as depth. depth: a depth
    ///             texture of another target to share; 0: none.
    /// Errors      Error{unsupported} if OpenGL refuses the formats or the size.
    RenderTarget(std::uint32_t width, std::uint32_t height, std::initializer_list<GLenum> formats,
                 GLuint depth = 0);

    void bind() const;
    void bind_texture(std::size_t index, GLuint unit) const;
    [[nodiscard]] GLuint framebuffer() const { return framebuffer_.name(); }
    [[nodiscard]] GLuint texture(std::size_t index) const { return textures_[index].name(); }
    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }

private:
    std::uint32_t width_, height_;
    std::array<GlTexture, 2> textures_;
    GlFramebuffer framebuffer_;
};

/// The buffers of a picture. They are kept from picture to picture while the size stays.
class FrameTargets {
public:
    /// In          width, height: of the picture; samples: along a side of a pixel.
    void resize(std::uint32_t width, std::uint32_t height, std::uint32_t samples);

    /// Parts and normals (0) and depth (1), in samples.
    [[nodiscard]] const RenderTarget& parts() const { return *parts_; }
    // The others are made when they are first asked for.
    const RenderTarget& ghosts();    ///< how much they let through, in samples
    const RenderTarget& colours();   ///< the picture, in samples
    const RenderTarget& half();      ///< the picture, in half as many samples
    const RenderTarget& occlusion(); ///< in pixels, noisy: seen, depth
    const RenderTarget& smooth();    ///< in pixels
    const RenderTarget& picture();   ///< in pixels

private:
    using Held = std::unique_ptr<RenderTarget>;

    std::uint32_t width_ = 0, height_ = 0, samples_ = 0;
    Held parts_, ghosts_, colours_, half_, occlusion_, smooth_, picture_;
};

} // namespace abut
