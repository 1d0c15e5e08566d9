#include "render/distance_layer.h"

#include "core/parallel.h"
#include "math/rounding.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

constexpr float kFar = 2;                ///< a fraction that keeps the part's own colour
constexpr float kUnknown = -1;           ///< is computed in the second pass
constexpr GLuint kPartBits = 0x3fffffff; ///< all of them: the ground
constexpr double kLargestCell = 0.1;     ///< of the reach: where interpolation ends

float fraction(double distance, double reach) {
    const double part = distance / reach;
    return part < 1 ? to_float(std::max(0.0, part)) : kFar;
}

} // namespace

void DistanceLayer::read(const DrawnCamera& camera, const RenderTarget& parts,
                         const std::array<float, 3>& depth_to_w, std::uint32_t samples) {
    width_ = camera.width, height_ = camera.height;
    const std::size_t row = parts.width(), count = row * parts.height();
    samples_.resize(count);
    depths_.resize(count);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, parts.framebuffer());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    const auto width = static_cast<GLsizei>(parts.width());
    const auto height = static_cast<GLsizei>(parts.height());
    glReadPixels(0, 0, width, height, GL_RG_INTEGER, GL_UNSIGNED_INT, samples_.data());
    glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depths_.data());
    seen_.resize(std::size_t{width_} * height_);
    parallel_for(height_, 8, [&](std::size_t y) {
        for (std::size_t x = 0; x < width_; ++x) {
            const std::size_t column = x * samples + samples / 2, line = y * samples + samples / 2;
            const std::size_t from = line * row + column;
            const GLuint number = samples_[from][0] & kPartBits;
            Seen& seen = seen_[y * width_ + x];
            seen.part = number == kPartBits ? 0 : number;
            const double across = (static_cast<double>(column) + 0.5) / parts.width() * 2 - 1;
            const double up = (static_cast<double>(line) + 0.5) / parts.height() * 2 - 1;
            const double w = double{depth_to_w[0]} /
                             (double{depth_to_w[1]} + double{depth_to_w[2]} * depths_[from]);
            seen.point =
                camera.eye + w * (camera.forward + (across * camera.slope_x) * camera.right +
                                  (up * camera.slope_y) * camera.up);
        }
    });
}

/// Interpolates between the grid points around a pixel, or returns kUnknown.
float DistanceLayer::interpolated(std::uint32_t x, std::uint32_t y, std::uint32_t grid,
                                  double reach) const {
    const std::uint32_t x0 = x / grid * grid, y0 = y / grid * grid;
    const std::uint32_t x1 = x0 + grid, y1 = y0 + grid;
    if (x1 >= width_ || y1 >= height_)
        return kUnknown;
    const auto index = [&](std::uint32_t i, std::uint32_t k) {
        return std::size_t{k} * width_ + i;
    };
    const Seen& here = seen_[index(x, y)];
    const std::array<std::size_t, 4> corners{index(x0, y0), index(x1, y0), index(x0, y1),
                                             index(x1, y1)};
    for (const std::size_t corner : corners)
        if (seen_[corner].part != here.part ||
            length(seen_[corner].point - here.point) > kLargestCell * reach)
            return kUnknown;
    const auto value = [&](std::size_t which) { return distances_[corners.at(which)]; };
    if (std::ranges::any_of(corners, [&](std::size_t corner) { return distances_[corner] >= 1; }))
        return value(0) >= 1 && value(1) >= 1 && value(2) >= 1 && value(3) >= 1 ? kFar : kUnknown;
    const float s = static_cast<float>(x - x0) / static_cast<float>(grid);
    const float t = static_cast<float>(y - y0) / static_cast<float>(grid);
    return (1 - t) * ((1 - s) * value(0) + s * value(1)) + t * ((1 - s) * value(2) + s * value(3));
}

void DistanceLayer::compute(const DistanceColours& colours) {
    const std::uint32_t grid = std::max(1U, colours.grid);
    distances_.assign(seen_.size(), kFar);
    const auto exact = [&](std::size_t pixel) {
        const Seen& seen = seen_[pixel];
        return seen.part == 0
                   ? kFar
                   : fraction(colours.distance(seen.part - 1, seen.point), colours.reach);
    };
    parallel_for((height_ + grid - 1) / grid, 1, [&](std::size_t line) {
        for (std::size_t x = 0; x < width_; x += grid) {
            const std::size_t pixel = line * grid * width_ + x;
            distances_[pixel] = exact(pixel);
        }
    });
    if (grid == 1)
        return;
    parallel_for(height_, 4, [&](std::size_t line) {
        const auto y = static_cast<std::uint32_t>(line);
        for (std::uint32_t x = 0; x < width_; ++x) {
            const std::size_t pixel = line * width_ + x;
            if ((x % grid == 0 && y % grid == 0) || seen_[pixel].part == 0)
                continue;
            const float between = interpolated(x, y, grid, colours.reach);
            distances_[pixel] = between == kUnknown ? exact(pixel) : between;
        }
    });
}

void DistanceLayer::update(const DistanceColours& colours, const DrawnCamera& camera,
                           const RenderTarget& parts, const std::array<float, 3>& depth_to_w,
                           std::uint32_t samples, GLuint unit) {
    read(camera, parts, depth_to_w, samples);
    compute(colours);
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, static_cast<GLsizei>(width_),
                 static_cast<GLsizei>(height_), 0, GL_RED, GL_FLOAT, distances_.data());
}

} // namespace abut
