#pragma once

#include "math/vector.h"

#include <array>
#include <cstdint>

namespace abut {

/// How a closed segment and a triangle meet.
enum class SegmentContact : std::uint8_t {
    none,     ///< no common point
    touch,    ///< a common point, but they do not cross; or one of them is degenerate
    coplanar, ///< common points, and the segment lies in the triangle's plane
    cross,    ///< the segment passes from one side of the triangle to the other, strictly inside
};

/// Whether a segment and a triangle share a point, and how.
///
/// In          any five finite points in one frame.
/// Degenerate  a segment without length is a point, a zero-area triangle a segment or a point.
///             These touch at most.
/// Accuracy    exact.
/// Cost        two orientation signs for most pairs, up to five where the segment reaches the
///             triangle's plane, and more for coplanar or degenerate ones.
SegmentContact segment_triangle_contact(const Vec3& p, const Vec3& q, const Triangle& t);

/// A point that a segment and a triangle share: the only one, or the middle of the shared segment.
struct SegmentPoint {
    Vec3 point;
    double along = 0;                ///< 0 at p, 1 at q
    std::array<double, 3> weights{}; ///< barycentric in the triangle
};

/// In          a segment and a triangle that share a point.
/// Accuracy    within 2^-36 of the segment's length of a shared point; the numbers to rounding.
SegmentPoint segment_triangle_point(const Vec3& p, const Vec3& q, const Triangle& t);

} // namespace abut
