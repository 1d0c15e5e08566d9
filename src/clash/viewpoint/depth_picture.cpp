#include "clash/viewpoint/depth_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

/// Depths that differ relatively by less than this count as equal.
constexpr double kSameDepth = 1e-7;
/// Triangles are cut away where they are nearer to the eye than this fraction of their size.
constexpr double kNearest = 1e-6;

} // namespace

DepthPicture::DepthPicture(std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), near_(std::size_t{width} * height),
      owners_(std::size_t{width} * height, kNothing) {}

void DepthPicture::begin(const CameraFrame& camera) {
    eye_ = camera.eye;
    right_ = (0.5 * width_ / camera.slope_x) * camera.right;
    up_ = (0.5 * height_ / camera.slope_y) * camera.up;
    forward_ = camera.forward;
    std::ranges::fill(near_, 0.0);
    std::ranges::fill(owners_, kNothing);
}

void DepthPicture::draw(const Triangle& triangle, std::uint32_t owner) {
    std::array<Vec3, 3> seen{}; // right, up, depth
    double size = 0, nearest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 d = triangle.at(i) - eye_;
        seen.at(i) = {dot(right_, d), dot(up_, d), dot(forward_, d)};
        size = std::max(size, max_abs(d));
        nearest = i == 0 ? seen[0].z : std::min(nearest, seen.at(i).z);
    }
    const double least = kNearest * size;
    const auto project = [&](const Vec3& p) {
        return Corner{0.5 * width_ + p.x / p.z, 0.5 * height_ - p.y / p.z, 1 / p.z};
    };
    if (nearest > least) {
        fill(project(seen[0]), project(seen[1]), project(seen[2]), owner);
        return;
    }
    // Cut at the plane in front of the eye: three or four corners remain.
    std::array<Vec3, 4> kept{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &from = seen.at(i), &to = seen.at((i + 1) % 3);
        if (from.z > least)
            kept.at(count++) = from;
        if ((from.z > least) != (to.z > least)) {
            const double t = (least - from.z) / (to.z - from.z);
            kept.at(count++) = from + t * (to - from);
            kept.at(count - 1).z = least;
        }
    }
    if (!(least > 0))
        return;
    for (std::size_t i = 2; i < count; ++i)
        fill(project(kept[0]), project(kept.at(i - 1)), project(kept.at(i)), owner);
}

void DepthPicture::take(std::size_t pixel, bool is_dark, double near, std::uint32_t owner) {
    double& known = near_[pixel];
    if (near < known * (1 - kSameDepth))
        return;
    if (near <= known * (1 + kSameDepth) && owners_[pixel] != owner &&
        is_dark == (owner < owners_[pixel]))
        return;
    known = std::max(near, known);
    owners_[pixel] = owner;
}

void DepthPicture::fill(const Corner& a, const Corner& b, const Corner& c, std::uint32_t owner) {
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (!(std::abs(area) > 1e-12) || !std::isfinite(area))
        return;
    // The pixels whose middles, at .5, may lie in the triangle.
    const auto first = [](double low, std::uint32_t size) {
        return static_cast<std::uint32_t>(std::clamp(std::ceil(low - 0.5), 0.0, double(size)));
    };
    const auto last = [](double high, std::uint32_t size) {
        return static_cast<std::uint32_t>(std::clamp(std::floor(high + 0.5), 0.0, double(size)));
    };
    const std::uint32_t x0 = first(std::min({a.x, b.x, c.x}), width_),
                        x1 = last(std::max({a.x, b.x, c.x}), width_),
                        y0 = first(std::min({a.y, b.y, c.y}), height_),
                        y1 = last(std::max({a.y, b.y, c.y}), height_);
    const double scale = 1 / area;
    // Weights of b and c at a pixel are linear in x and y.
    const double b_x = scale * (c.y - a.y), b_y = -scale * (c.x - a.x);
    const double c_x = -scale * (b.y - a.y), c_y = scale * (b.x - a.x);
    for (std::uint32_t y = y0; y < y1; ++y)
        for (std::uint32_t x = x0; x < x1; ++x) {
            const double dx = x + 0.5 - a.x, dy = y + 0.5 - a.y;
            const double of_b = b_x * dx + b_y * dy, of_c = c_x * dx + c_y * dy;
            const double of_a = 1 - of_b - of_c;
            if (of_a < 0 || of_b < 0 || of_c < 0)
                continue;
            take(std::size_t{y} * width_ + x, ((x + y) & 1U) != 0,
                 of_a * a.near + of_b * b.near + of_c * c.near, owner);
        }
}

} // namespace abut
