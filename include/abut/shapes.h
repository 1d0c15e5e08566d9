#pragma once

#include <abut/types.h>

#include <limits>

/// Simple shapes for queries on one model (abut/shape_queries.h). All are in the world frame.
namespace abut {

/// The points origin + t direction with t_min <= t <= t_max, in real arithmetic without rounding.
///
/// The direction need not be of unit length; t counts in its lengths. A query throws an Error for a
/// zero direction. An empty range contains no point. Both ends may be infinite.
struct Ray {
    Vec3 origin, direction;
    double t_min = 0, t_max = std::numeric_limits<double>::infinity();
};

/// A closed segment; if its ends are equal, a point.
struct Segment {
    Vec3 a, b;
};

/// A closed ball: its surface and its interior.
struct Sphere {
    Vec3 centre;
    double radius = 0; ///< not negative; 0 means a point
};

/// A closed solid: all points at most `radius` from a segment.
struct Capsule {
    Segment axis;
    double radius = 0; ///< not negative; 0 means the segment
};

/// A solid box in its own frame. Its corners are those of `box`, mapped as Transform defines.
///
/// Twelve triangles between these eight corners bound the solid. Each face is cut along the
/// diagonal from its least corner in the box's frame, so the solid is defined to the last bit,
/// however the transform rounds. A singular transform flattens it.
struct OrientedBox {
    Box3 box;
    Transform world_from_box;
};

} // namespace abut
