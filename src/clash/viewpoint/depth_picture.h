#pragma once

#include "math/vector.h"
#include "view/camera/camera_frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A small picture that knows the nearest part of each pixel.
class DepthPicture {
public:
    DepthPicture(std::uint32_t width, std::uint32_t height);

    /// Empties the picture. The camera's size is that of the picture.
    void begin(const CameraFrame& camera);

    /// Draws a triangle; both of its sides are visible. Where two parts are equally far away, they
    /// share the pixels like the fields of a chessboard.
    void draw(const Triangle& triangle, std::uint32_t owner);

    /// Returns the owner of every pixel that a triangle covers; kNothing elsewhere.
    [[nodiscard]] std::span<const std::uint32_t> owners() const { return owners_; }
    static constexpr std::uint32_t kNothing = 0xfffffffeU;

private:
    struct Corner {
        double x, y, near; ///< pixels; 1 / depth
    };
    void fill(const Corner& a, const Corner& b, const Corner& c, std::uint32_t owner);
    void take(std::size_t pixel, bool is_dark, double near, std::uint32_t owner);

    std::uint32_t width_, height_;
    Vec3 eye_, right_, up_, forward_; ///< right and up: divided by half of a pixel at depth 1
    std::vector<double> near_;        ///< 1 / depth of each pixel; 0: nothing
    std::vector<std::uint32_t> owners_;
};

} // namespace abut
