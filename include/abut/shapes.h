#pragma once

#include <abut/types.h>

#include <limits>

/// Simple shapes that one model can be asked about (abut/shape_queries.h). All in the world frame.
namespace abut {

/// The points origin + t direction, t_min <= t <= t_max, in real numbers: nothing is rounded.
///
/// The direction need not be of unit length (t counts in its lengths); zero is an Error when it is
/// used. A range that is empty holds no point; both ends may be infinite.
struct Ray {
    Vec3 origin, direction;
    double t_min = 0, t_max = std::numeric_limits<double>::infinity();
};

/// Closed segment; a point if its ends are equal.
struct Segment {
    Vec3 a, b;
};

/// Closed ball: its surface and all that lies inside.
struct Sphere {
    Vec3 centre;
    double radius = 0; ///< not negative; 0: a point
};

/// Closed solid: all points at most `radius` from a segment.
struct Capsule {
    Segment axis;
    double radius = 0; ///< not negative; 0: the segment
};

/// A solid box in a frame of its own. Its corners are those of `box`, mapped as Transform says.
///
/// The solid is bounded by twelve triangles between these eight points, each face cut along the
/// diagonal that leaves its least corner (in the box's frame), so that it is defined to the last
/// bit whatever the transform rounds. A singular transform flattens it.
struct OrientedBox {
    Box3 box;
    Transform world_from_box;
};

} // namespace abut
