#pragma once

#include "math/vector.h"

#include <array>
#include <cstdint>
#include <span>

namespace abut {

/// A connected set of points as a line with a thickness.
struct Stick {
    Vec3 a, b; ///< ends of its axis
    /// No point of the set is farther from the axis, and no point of the axis from the set.
    double radius = 0;
};

/// Returns the stick of a set. Its axis has about the direction of the set's largest extent.
///
/// In          points: the corners of triangles that are connected; at least one.
/// Accuracy    the radius is an upper bound, to rounding: the set has a point in each plane across
///             the axis between its ends.
Stick stick_of(std::span<const Vec3> points);

/// An upper bound on the distance of any point of one axis from the other axis.
double axis_gap(const Stick& from, const Stick& to);

/// Returns the numbers of four points that are the corners of a tetrahedron which resembles the set:
/// two at either end, in directions across each other, so that it can be seen from all sides. Its
/// faces are (0, 1, 2), (0, 2, 3), (0, 3, 1) and (1, 3, 2), seen from outside. Numbers are equal
/// if the set is too flat.
std::array<std::uint32_t, 4> stick_corners(std::span<const Vec3> points, const Stick& stick);

} // namespace abut
