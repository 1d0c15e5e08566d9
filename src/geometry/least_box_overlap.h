#pragma once

#include "geometry/rounded_box_distance.h"

#include <cstdint>
#include <limits>

namespace abut {

/// The axis along which two boxes overlap least or, if they are apart, are farthest apart.
struct LeastOverlap {
    double overlap = std::numeric_limits<double>::infinity(); ///< negative if they are apart
    Vec3 normal;                                              ///< from a to b
    enum class Kind : std::uint8_t { face_a, face_b, edges } kind = Kind::face_a;
};

/// The least overlap of the boxes, without their radii, among the 15 axes that can separate them.
///
/// In          farthest: if an axis of a face tells that the boxes are farther apart, the search
///             ends with that axis.
/// Accuracy    a few roundings of the centres' differences.
/// Source      separating axes [Gottschalk, Lin, Manocha 1996].
LeastOverlap least_overlap(const RoundedBox& a, const RoundedBox& b,
                           double farthest = std::numeric_limits<double>::infinity());

} // namespace abut
