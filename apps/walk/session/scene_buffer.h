#pragma once

#include <abut/renderer.h>

#include <cstdint>

namespace abut::viewer {

/// Keeps the picture of the scene, so that panels over it can change without a new one.
class SceneBuffer {
public:
    SceneBuffer() = default;
    ~SceneBuffer();
    SceneBuffer(const SceneBuffer&) = delete;
    SceneBuffer& operator=(const SceneBuffer&) = delete;

    /// Binds it for drawing, at a size.
    void bind(std::uint32_t width, std::uint32_t height);
    /// Copies it to the window.
    void show() const;
    [[nodiscard]] Picture read() const;

private:
    std::uint32_t width_ = 0, height_ = 0;
    unsigned framebuffer_ = 0, colours_ = 0;
};

} // namespace abut::viewer
