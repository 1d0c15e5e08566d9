#include "render/depth_tiles.h"

#include "render/shaders/screen_shaders.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace abut {

namespace {

/// Depths are compared with this relative margin, which single precision stays below.
constexpr double kMargin = 1e-3;
/// Samples by which the image of a box is enlarged.
constexpr double kBorder = 1;

} // namespace

void DepthTiles::read(const RenderTarget& parts, const DrawnCamera& camera,
                      const std::array<float, 3>& depth_to_w, const Vec3& origin) {
    const std::uint32_t width = parts.width(), height = parts.height();
    width_ = width, height_ = height;
    is_of_this_picture_ = true;
    columns_ = (width + kTile - 1) / kTile, rows_ = (height + kTile - 1) / kTile;
    eye_ = camera.eye - origin;
    right_ = (1 / camera.slope_x) * camera.right, up_ = (1 / camera.slope_y) * camera.up;
    forward_ = camera.forward;
    near_ = camera.near;
    if (!target_ || target_->width() != columns_ || target_->height() != rows_)
        target_ =
            std::make_unique<RenderTarget>(columns_, rows_, std::initializer_list<GLenum>{GL_R32F});
    if (!program_)
        program_ =
            std::make_unique<ShaderProgram>("", kScreenVertexShader, kFarthestFragmentShader);
    parts.bind_texture(1, 1);
    target_->bind();
    glDisable(GL_DEPTH_TEST);
    program_->use();
    program_->set("u_depth", 1);
    program_->set("u_depth_to_w", depth_to_w);
    glBindVertexArray(no_attributes_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
    farthest_.resize(std::size_t{columns_} * rows_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target_->framebuffer());
    glReadPixels(0, 0, static_cast<GLsizei>(columns_), static_cast<GLsizei>(rows_), GL_RED,
                 GL_FLOAT, farthest_.data());
}

bool DepthTiles::hides(const std::array<float, 3>& lower, const std::array<float, 3>& upper) const {
    double left = HUGE_VAL, right = -HUGE_VAL, bottom = HUGE_VAL, top = -HUGE_VAL,
           nearest = HUGE_VAL;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 d = Vec3{double{(corner & 1U) != 0 ? upper[0] : lower[0]},
                            double{(corner & 2U) != 0 ? upper[1] : lower[1]},
                            double{(corner & 4U) != 0 ? upper[2] : lower[2]}} -
                       eye_;
        const double w = dot(d, forward_);
        if (!(w > near_))
            return false;
        const double x = 0.5 * width_ * (1 + dot(d, right_) / w),
                     y = 0.5 * height_ * (1 + dot(d, up_) / w);
        left = std::min(left, x), right = std::max(right, x);
        bottom = std::min(bottom, y), top = std::max(top, y);
        nearest = std::min(nearest, w);
    }
    left -= kBorder, right += kBorder, bottom -= kBorder, top += kBorder;
    if (!is_of_this_picture_ && (left < 0 || bottom < 0 || right > width_ || top > height_))
        return false;
    const auto tile_of = [](double at, std::uint32_t count) {
        return static_cast<std::size_t>(
            std::clamp(at / kTile, 0.0, static_cast<double>(count - 1)));
    };
    const std::size_t x0 = tile_of(left, columns_), x1 = tile_of(right, columns_);
    const std::size_t y0 = tile_of(bottom, rows_), y1 = tile_of(top, rows_);
    const double limit = nearest * (1 - kMargin);
    for (std::size_t y = y0; y <= y1; ++y)
        for (std::size_t x = x0; x <= x1; ++x)
            if (!(double{farthest_[y * columns_ + x]} < limit))
                return false;
    return true;
}

} // namespace abut
