#pragma once

#include "geometry/least_box_overlap.h"
#include "world/solids/four_points.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace abut {

/// The region in which the facing sides of two boxes lie over each other along the contact normal.
///
/// One side is the reference: that whose normal is the contact's, or that of a. The other one is moved along
/// the normal onto the plane of the reference, where it is cut by the four edges of that rectangle.
struct BoxRegion {
    /// The corners, with their names. x and y are seen along the normal, in the axes of a ContactFrame.
    std::array<RegionPoint, 8> corners;
    std::array<double, 8> along_u,
        along_v;           ///< places of the corners: from the middle of the reference side
    std::size_t count = 0; ///< of the corners
    double deepest;        ///< the largest depth; minus infinity if there are no corners
    Vec3 middle, edge_u,
        edge_v; ///< of the reference side, in the world; the edges are of unit length
    bool reference_is_a = true;

    /// In          least: of the two boxes. least_depth: corners that are less deep are left out.
    /// Cost        no allocation.
    /// Source      [Sutherland, Hodgman 1974], with a rectangle that lies along the axes.
    BoxRegion(const RoundedBox& a, const RoundedBox& b, const BoxAxes& axes,
              const LeastOverlap& least, double least_depth);

    /// The point of the reference box at a corner.
    [[nodiscard]] Vec3 on_reference(std::size_t corner) const {
        return middle + (along_u[corner] * edge_u + along_v[corner] * edge_v);
    }
};

} // namespace abut
