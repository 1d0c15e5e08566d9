#pragma once

#include "world/solids/contact_candidate.h"

#include <span>

namespace abut {

/// The plane of a polygon, as a height over the contact frame.
struct FacePlane {
    double x, y, height, slope_x, slope_y;

    FacePlane(const FlatCorner& on, const Vec3& normal, const ContactFrame& frame)
        : x(on.x), y(on.y), height(on.height) {
        const double up = dot(normal, frame.normal);
        slope_x = -dot(normal, frame.across_x) / up, slope_y = -dot(normal, frame.across_y) / up;
    }
    [[nodiscard]] double at(double px, double py) const {
        return height + slope_x * (px - x) + slope_y * (py - y);
    }
};

/// Adds the corners of the region in which two convex polygons lie over each other along the normal,
/// with their names. None if they do not overlap.
///
/// In          a, b: each counter-clockwise, seen from outside of its solid. plane: of a.
/// Cost        proportional to the product of the numbers of corners. Up to 16 corners of both: no
///             allocation.
/// Source      [Sutherland, Hodgman 1974].
void add_polygon_overlap(std::span<const FlatCorner> a, std::span<const FlatCorner> b,
                         const FacePlane& plane, ContactCandidates& candidates);

} // namespace abut
