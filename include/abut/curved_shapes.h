#pragma once

#include <abut/shapes.h>
#include <abut/types.h>

/// Solids with curved surfaces, and half-spaces: shapes of the bodies of a world (abut/world.h), in
/// the body's frame. docs/curved-shapes.md explains their queries.
namespace abut {

/// A closed solid: the hull of two discs of the same radius, which lie across the axis at its ends.
///
/// Degenerate  a radius of 0 gives the segment. Equal ends are an Error, since the axis then has no
///             direction, unless the radius is 0 too.
struct Cylinder {
    Segment axis;
    double radius = 0; ///< not negative
};

/// A closed solid: the hull of an apex and a disc around `base`, which lies across the axis.
///
/// Degenerate  as Cylinder.
struct Cone {
    Vec3 apex, base;
    double radius = 0; ///< not negative
};

/// A closed solid: all points with (x / a)^2 + (y / b)^2 + (z / c)^2 <= 1 relative to the centre,
/// where a, b, c are the semi-axes. Its axes are those of the frame.
///
/// Degenerate  a semi-axis of 0 flattens it to an ellipse, a segment or a point.
struct Ellipsoid {
    Vec3 centre, semi_axes; ///< semi-axes: lengths, not negative
};

/// A closed solid without end: all points x with normal . x <= offset.
///
/// The normal points out of the solid. It need not be of unit length; a zero normal is an Error.
struct HalfSpace {
    Vec3 normal;
    double offset = 0;
};

} // namespace abut
