#pragma once

#include "convex/support/support_shape.h"

#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>

namespace abut {

/// The part of a cylinder, a cone or an ellipsoid that faces a direction: a disc, as a regular polygon of 16
/// corners on its rim; a line on the side of a cylinder or cone; or a point.
///
/// The corners are relative to the solid's centre. One of them is the point of the part that is farthest along
/// the direction: the corner nearest to it moves there.
struct CurvedSide {
    static constexpr std::uint32_t kRim = 16; ///< corners of a disc
    static constexpr std::uint32_t kLine = 2 * kRim;

    struct Corner {
        Vec3 at;
        /// On the rim at the end of the axis 0 to 15, on that at its start 16 to 31, by their angle about the
        /// axis. An end of a line: 32 at the start of the axis, 33 at its end. The point of an ellipsoid: 0.
        std::uint32_t vertex = 0;
        std::uint32_t edge = 0; ///< to the next corner: that of the rim, or 32 of a line
    };
    boost::container::static_vector<Corner, kRim> corners; ///< counter-clockwise, seen from outside
    Vec3 normal; ///< of a disc: outward, of unit length; else zero

    [[nodiscard]] bool is_disc() const { return corners.size() > 2; }
    /// The corner that is farthest along a direction.
    [[nodiscard]] const Corner& farthest(const Vec3& direction) const;
    /// Whether the disc or the line lies across a unit vector, to 2 degrees. A point does not.
    [[nodiscard]] bool lies_across(const Vec3& direction) const;
};

/// Whether the shape is a cylinder, a cone or an ellipsoid with an extent along each axis.
bool has_curved_side(const SupportShape& solid);

/// Finds the part that faces a direction: of disc and line, the one whose normal is nearer to it.
///
/// In          has_curved_side(solid). direction: of unit length, out of the solid.
CurvedSide side_towards(const SupportShape& solid, const Vec3& direction);

/// The part of a line inside a solid.
struct LineChord {
    double begin = 0, end = 0; ///< distances along the line
};

/// The part of a line inside a solid; none if they share no point.
///
/// In          has_curved_side(solid). from: relative to the solid's centre. along: of unit length.
/// Accuracy    a few roundings, over the cosine between the line and the solid's normal.
std::optional<LineChord> part_inside(const SupportShape& solid, const Vec3& from,
                                     const Vec3& along);

} // namespace abut
