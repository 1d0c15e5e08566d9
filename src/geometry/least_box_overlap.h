#pragma once

#include "geometry/rounded_box_distance.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace abut {

/// No axis of two boxes.
inline constexpr std::uint8_t kNoAxis = 255;

/// The scalar products that the axes of two boxes share.
struct BoxAxes {
    double turn[3][3]; ///< of axis i of a and axis k of b
    double way[6]; ///< from the centre of a to that of b, along the axes of a and then those of b

    BoxAxes(const RoundedBox& a, const RoundedBox& b) {
        const Vec3 d = b.centre - a.centre;
        for (std::size_t i = 0; i < 3; ++i) {
            way[i] = dot(d, a.axis[i]);
            way[3 + i] = dot(d, b.axis[i]);
            for (std::size_t k = 0; k < 3; ++k)
                turn[i][k] = dot(a.axis[i], b.axis[k]);
        }
    }
};

/// The axis along which two boxes overlap least or, if they are apart, are farthest apart.
struct LeastOverlap {
    double overlap = std::numeric_limits<double>::infinity(); ///< negative if they are apart
    Vec3 normal;                                              ///< from a to b
    enum class Kind : std::uint8_t { face_a, face_b, edges } kind = Kind::face_a;
    /// The number of the axis: 0 to 2 of a, 3 to 5 of b, then the cross products of axis i of a and axis k
    /// of b, 6 + 3 i + k.
    std::uint8_t axis = 0;
};

/// The least overlap of the boxes, without their radii, among the 15 axes that can separate them.
///
/// In          farthest: if an axis of a face tells that the boxes are farther apart, the search
///             ends with that axis.
/// Accuracy    a few roundings of the centres' differences.
/// Source      separating axes [Gottschalk, Lin, Manocha 1996].
LeastOverlap least_overlap(const RoundedBox& a, const RoundedBox& b, const BoxAxes& axes,
                           double farthest = std::numeric_limits<double>::infinity());
LeastOverlap least_overlap(const RoundedBox& a, const RoundedBox& b,
                           double farthest = std::numeric_limits<double>::infinity());

/// The number of the same axis where a and b are exchanged.
inline std::uint8_t exchanged_axis(std::uint8_t axis) {
    if (axis == kNoAxis)
        return axis;
    const int of_edges = axis - 6;
    return static_cast<std::uint8_t>(axis < 3   ? axis + 3
                                     : axis < 6 ? axis - 3
                                                : 6 + 3 * (of_edges % 3) + of_edges / 3);
}

} // namespace abut
