#pragma once

#include <abut/renderer.h>

#include "render/drawn_camera.h"
#include "render/gl_handle.h"
#include "render/shader_program.h"

#include <memory>
#include <span>

namespace abut {

/// Draws marks over a picture.
class MarkLayer {
public:
    /// Draws into the framebuffer that is bound. Texture unit 1 has the depth of the picture.
    ///
    /// In          depth_to_w: as the shaders know it; samples: of the depth texture, along a side
    ///             of a pixel.
    void draw(std::span<const Mark> marks, const DrawnCamera& camera,
              const std::array<float, 3>& depth_to_w, std::uint32_t samples);

private:
    std::unique_ptr<ShaderProgram> program_;
    GlVertexArray array_;
    GlBuffer vertices_;
};

} // namespace abut
