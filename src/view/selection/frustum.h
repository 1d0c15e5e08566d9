#pragma once

#include <abut/types.h>

#include "view/camera/camera_frame.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace abut {

/// The pyramid that a camera sees, in the frame of a tree of levels (world minus its origin).
class Frustum {
public:
    /// A bit for each plane that may still cut the box: sides, near, far.
    static constexpr std::uint32_t kAllPlanes = 0x3f;
    /// Returned for a box that is outside.
    static constexpr std::uint32_t kOutside = 0x80;

    /// Sees nothing.
    Frustum() = default;
    /// In          widening: factor of the slopes, to see more than the picture.
    Frustum(const CameraFrame& frame, double near, double far, const Vec3& origin,
            double widening = 1);

    /// Returns the planes of `planes` that cut the box, or kOutside if the box is certainly outside
    /// of one of them. A box inside of a plane has its descendants inside of it too.
    [[nodiscard]] std::uint32_t cut(const std::array<float, 3>& lower,
                                    const std::array<float, 3>& upper, std::uint32_t planes) const;
    [[nodiscard]] bool may_see(const std::array<float, 3>& lower,
                               const std::array<float, 3>& upper) const {
        return cut(lower, upper, kAllPlanes) != kOutside;
    }

private:
    /// The points p with dot(normal, p) >= offset.
    struct Plane {
        Vec3 normal;
        double offset = 1;
    };
    static constexpr std::size_t kPlanes = 6;
    std::array<Plane, kPlanes> planes_{};
    double size_ = 0; ///< bound of the offsets, for the rounding errors
};

} // namespace abut
