#pragma once

#include "rigid/manifold/triangle_meeting.h"

#include <span>

namespace abut {

/// Where a region lies, and along which direction it parts.
struct RegionFrame {
    Vec3 normal;          ///< unit vector from a to b
    Vec3 across, upwards; ///< with the normal, an orthonormal basis
    Vec3 centre;          ///< the mean of the points that the surfaces share
    bool crosses = false; ///< some of its triangles cross, other than along rounding noise
    /// No triangles cross, and no faces share an area that parts the models: the region alone does
    /// not tell whether the models' interiors overlap.
    bool only_touches = false;
    /// It crosses, and holds faces that lie in one plane and look the same way: parts of its curve
    /// may be missing, so its normal is in doubt.
    bool is_flush = false;
    bool is_flat = false; ///< the normal is that of faces that lie on each other
    /// The curve goes around a place where the bodies do not meet: the inner border of a ring.
    bool is_hole = false;

    /// The normal is not that of the triangles that meet, which only touch: where they do, lines along the
    /// normal may be inside both bodies.
    bool is_given = false;

    /// The place of a point seen along the normal, relative to the centre.
    [[nodiscard]] double right(const Vec3& p) const { return dot(across, p - centre); }
    [[nodiscard]] double up(const Vec3& p) const { return dot(upwards, p - centre); }
};

/// The rounding of heights and gaps in the frame of the sides: that of positions, and sums of their products.
inline double rounding_of_heights(const ManifoldSide& a, const ManifoldSide& b) {
    return 0x1p-46 * (a.model().reach() + b.model().reach());
}

/// Finds the normal of a region.
///
/// Crossing surfaces: the direction of the vector area that their common curve encloses. If the
/// curve encloses little for its length, or the region is a part of a longer curve, the mean normal
/// of the flatter side. If many faces of one side within 30 degrees of that have the same normal,
/// it is theirs. Touching faces: the normal of the common area; else the mean direction across the
/// features that touch, or what the models' triangles tell there. Near triangles: the direction of the smallest gap.
///
/// In          region: not empty; `whole`: not a part of a longer curve.
RegionFrame region_frame(const ManifoldSide& a, const ManifoldSide& b,
                         std::span<const TriangleMeeting> region, bool whole);

} // namespace abut
