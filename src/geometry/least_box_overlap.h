#pragma once

#include "geometry/rounded_box_distance.h"

#include <cstdint>
#include <limits>

namespace abut {

/// The axis along which two boxes overlap least, or are apart the farthest.
struct LeastOverlap {
    double overlap = std::numeric_limits<double>::infinity(); ///< negative: apart
    Vec3 normal;                                              ///< from a to b
    enum class Kind : std::uint8_t { face_a, face_b, edges } kind = Kind::face_a;
};

/// Of the boxes without their radii, among the 15 axes that can part them.
///
/// Accuracy    a few roundings of the centres' differences.
/// Source      separating axes [Gottschalk, Lin, Manocha 1996].
LeastOverlap least_overlap(const RoundedBox& a, const RoundedBox& b);

} // namespace abut
