#pragma once

#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <span>

namespace abut {

/// A corner of a contact region, seen along the normal.
struct RegionPoint {
    double x, y;
    double depth;
    std::uint64_t feature;
};

/// The places of up to four of the points, the deepest first. Of more than four, they are the deepest, the
/// one farthest from it, and on both sides of the line through these two the ones farthest from it.
///
/// Points of the last step stay where others are hardly better: where none is deeper by more than 2^-14
/// of the region's extent, and others hold less than 1.25 times the area. So bodies at rest keep their
/// points.
///
/// In          rounding: of depths. last: the names of points of the last step.
/// Accuracy    the four hold at least a quarter of the area of all; a little less than a fifth where
///             points of the last step stay.
boost::container::static_vector<std::size_t, 4> four_points(std::span<const RegionPoint> points,
                                                            double rounding,
                                                            std::span<const std::uint64_t> last);

} // namespace abut
