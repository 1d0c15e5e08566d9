#pragma once

#include <abut/types.h>

#include "geometry/rounded_box_distance.h"
#include "math/vector.h"
#include "world/curved/curved_side.h"
#include "world/narrow_phase/face_table.h"

#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <cstdint>

namespace abut {

/// The part of a solid that faces another solid: a flat convex polygon, a segment or a point, and a
/// radius around it. Only segments and points have a radius.
// NOLINTNEXTLINE(bugprone-exception-escape): its move fails only for lack of memory
struct ContactFace {
    struct Corner {
        Vec3 at;
        std::uint32_t vertex = 0;   ///< the number of this vertex in the solid
        std::uint32_t edge = 0;     ///< the number of the edge from this corner to the next
        std::uint32_t triangle = 0; ///< of a model: one that has the vertex
    };
    boost::container::small_vector<Corner, 8> corners; ///< counter-clockwise, seen from outside
    Vec3 normal;                                       ///< of a polygon: outward, of unit length
    double radius = 0;

    [[nodiscard]] bool is_polygon() const { return corners.size() > 2; }
};

/// The face of a rounded box whose outward normal is nearest to a direction. An axis without extent
/// makes it a segment or a point. Corners are relative to `origin`.
///
/// The vertex number has a bit for each axis, set on its positive side. An edge's number is 4 times
/// its axis plus the bits of the other two axes.
ContactFace contact_face(const RoundedBox& box, const Vec3& direction, const Vec3& origin);

/// The face of a convex body at its vertex that is farthest along a direction: of the faces there,
/// the one whose outward normal is nearest to the direction. If all of them stand on edge, as those
/// of a polygon may, it is an edge. Corners are relative to `origin`.
///
/// In          world_from_body: a rotation and a translation.
ContactFace contact_face(const Convex& body, const FaceTable& faces,
                         const Transform& world_from_body, const Vec3& direction,
                         const Vec3& origin);

/// The part of a cylinder, a cone or an ellipsoid that faces a direction. Corners are relative to `origin`.
///
/// In          has_curved_side(solid).
ContactFace contact_face(const SupportShape& solid, const Vec3& direction, const Vec3& origin);

} // namespace abut
