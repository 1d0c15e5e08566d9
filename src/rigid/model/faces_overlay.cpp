#include "rigid/model/faces_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace abut {

namespace {

/// A triangle cut by three lines has at most six corners.
struct CutTriangle {
    std::array<Vec3, 6> corners{};
    std::size_t count = 0;

    /// Keeps the part whose height over a plane is not negative.
    void keep(const Vec3& origin, const Vec3& inwards, double rim) {
        std::array<double, 6> height{};
        for (std::size_t i = 0; i < count; ++i)
            height.at(i) = dot(inwards, corners.at(i) - origin) - rim;
        CutTriangle left;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t j = (i + 1) % count;
            const double h = height.at(i), k = height.at(j);
            if (h >= 0 && left.count < corners.size())
                left.corners.at(left.count++) = corners.at(i);
            if (h * k < 0 && left.count < corners.size())
                left.corners.at(left.count++) =
                    corners.at(i) + h / (h - k) * (corners.at(j) - corners.at(i));
        }
        *this = left;
    }
};

} // namespace

FacesOverlay faces_overlay(const Triangle& f, const Triangle& g, double rim) {
    const Vec3 normal = normalized_or_zero(cross(f[1] - f[0], f[2] - f[0])),
               other = normalized_or_zero(cross(g[1] - g[0], g[2] - g[0]));
    constexpr double kMostSlope = 0.7; // a cosine
    if (std::abs(dot(normal, other)) < kMostSlope)
        return {};
    CutTriangle part;
    for (const Vec3& p : g)
        part.corners.at(part.count++) = p;
    for (std::size_t i = 0; i < 3 && part.count >= 3; ++i) {
        const Vec3& from = f.at(i);
        part.keep(from, normalized_or_zero(cross(normal, f.at((i + 1) % 3) - from)), rim);
    }
    FacesOverlay result;
    for (std::size_t i = 2; i < part.count; ++i)
        result.area += 0.5 * std::abs(dot(normal, cross(part.corners.at(i - 1) - part.corners[0],
                                                        part.corners.at(i) - part.corners[0])));
    for (std::size_t i = 0; i < part.count && result.area > 0; ++i)
        result.height = std::max(result.height, std::abs(dot(normal, part.corners.at(i) - f[0])));
    return result;
}

} // namespace abut
