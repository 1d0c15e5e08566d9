#pragma once

#include "math/vector.h"
#include "render/drawn_camera.h"
#include "render/frame_targets.h"
#include "render/shader_program.h"

#include <array>
#include <memory>
#include <vector>

namespace abut {

/// The farthest depth in each tile of a picture that is being drawn. What lies behind it is hidden.
/// For software rasterisers, where reading depth back is cheap and hidden triangles are expensive.
class DepthTiles {
public:
    static constexpr std::uint32_t kTile = 8; ///< samples along a side; the shader knows it, too

    /// Reads the depth of what has been drawn so far, which it waits for. Binds another framebuffer
    /// and texture unit 1.
    ///
    /// In          depth_to_w: w = x / (y + z * depth); origin: boxes are relative to it.
    void read(const RenderTarget& parts, const DrawnCamera& camera,
              const std::array<float, 3>& depth_to_w, const Vec3& origin);

    /// Returns whether a picture has been read.
    [[nodiscard]] bool is_read() const { return !farthest_.empty(); }
    /// From now on another picture is drawn: what the last one did not show may be visible.
    void begin_picture() { is_of_this_picture_ = false; }

    /// Returns whether nothing in the box could be seen in the picture that was read: each tile
    /// that its image touches is nearer.
    [[nodiscard]] bool hides(const std::array<float, 3>& lower,
                             const std::array<float, 3>& upper) const;

private:
    bool is_of_this_picture_ = false;
    std::uint32_t columns_ = 0, rows_ = 0;
    double width_ = 0, height_ = 0;
    Vec3 eye_, right_, up_, forward_; ///< right and up: scaled to the border of the picture
    double near_ = 0;
    std::unique_ptr<RenderTarget> target_;
    std::unique_ptr<ShaderProgram> program_;
    GlVertexArray no_attributes_;
    std::vector<float> farthest_; ///< by tile: w
};

} // namespace abut
