#pragma once

#include "geometry/least_box_overlap.h"
#include "world/solids/four_points.h"

#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <cstdint>

namespace abut {

/// The region in which the facing sides of two boxes lie over each other along the contact normal.
///
/// One side is the reference: that whose normal is the contact's, or that of a. The other one is moved along
/// the normal onto the plane of the reference, where it is cut by the four edges of that rectangle.
struct BoxRegion {
    /// A point of the reference side, from its middle along its two edges.
    struct Place {
        double u, v;
    };

    /// The corners, with their names. x and y are seen along the normal, in the axes of a ContactFrame.
    boost::container::static_vector<RegionPoint, 8> corners;
    boost::container::static_vector<Place, 8> places; ///< of the corners
    double deepest = 0;          ///< the largest depth; minus infinity if there are no corners
    Vec3 middle, edge_u, edge_v; ///< of the reference side, in the world; the edges are of unit length
    bool reference_is_a = true;

    /// In          least: of the two boxes. least_depth: corners that are less deep are left out.
    /// Cost        no allocation.
    /// Source      [Sutherland, Hodgman 1974], with a rectangle that lies along the axes.
    BoxRegion(const RoundedBox& a, const RoundedBox& b, const BoxAxes& axes,
              const LeastOverlap& least, double least_depth);

    /// The point of the reference box at a corner.
    [[nodiscard]] Vec3 on_reference(std::size_t corner) const {
        return middle + (places[corner].u * edge_u + places[corner].v * edge_v);
    }

private:
    /// Adds a corner. Of corners with the same name, the deepest remains.
    void add(const RegionPoint& corner, const Place& place);
};

} // namespace abut
