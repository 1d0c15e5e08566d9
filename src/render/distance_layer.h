#pragma once

#include <abut/renderer.h>

#include "render/drawn_camera.h"
#include "render/frame_targets.h"
#include "render/gl_handle.h"

#include <array>
#include <vector>

namespace abut {

/// The distances that colour the surfaces of a picture: one number a pixel, in a texture.
///
/// They are computed for the surface points of a grid of pixels. The pixels between are
/// interpolated where the four grid points around are on the pixel's part and near it, and are
/// computed otherwise, so that no distance is smeared over a silhouette.
class DistanceLayer {
public:
    /// Reads the drawn parts and depths back, computes the distances, and binds the texture.
    ///
    /// In          depth_to_w: as the shaders have it; samples: along a side of a pixel of `parts`.
    void update(const DistanceColours& colours, const DrawnCamera& camera,
                const RenderTarget& parts, const std::array<float, 3>& depth_to_w,
                std::uint32_t samples, GLuint unit);

private:
    struct Seen {
        std::uint32_t part = 0; ///< its number + 1; 0: none
        Vec3 point;
    };
    void read(const DrawnCamera& camera, const RenderTarget& parts,
              const std::array<float, 3>& depth_to_w, std::uint32_t samples);
    void compute(const DistanceColours& colours);
    [[nodiscard]] float interpolated(std::uint32_t x, std::uint32_t y, std::uint32_t grid,
                                     double reach) const;

    std::uint32_t width_ = 0, height_ = 0;
    std::vector<std::array<GLuint, 2>> samples_;
    std::vector<float> depths_;
    std::vector<Seen> seen_;       ///< by pixel, rows upward
    std::vector<float> distances_; ///< by pixel, as fractions of the reach; kFar: as far or farther
    GlTexture texture_;
};

} // namespace abut
