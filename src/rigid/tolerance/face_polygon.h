#pragma once

#include "math/vector.h"

#include <boost/container/static_vector.hpp>
#include <cstddef>

namespace abut {

/// A convex polygon: a piece of a face, with its corners in order. Corners may coincide.
using FacePolygon = boost::container::static_vector<Vec3, 24>;

/// A polygon of more corners is divided before it is cut, so that no cut exceeds the capacity.
inline constexpr std::size_t kMostCornersToCut = 8;

/// The half-space of points x with dot(x - point, normal) <= 0.
struct CuttingPlane {
    Vec3 point, normal;
};

struct CutPolygon {
    FacePolygon inside, outside; ///< either is empty if the other one is the whole polygon
};

/// Divides a polygon by a plane.
///
/// In          rounding: corners that are this near to the plane are on it.
/// Accuracy    the corners of the cut are off by a few roundings of the polygon's coordinates.
CutPolygon cut(const FacePolygon& polygon, const CuttingPlane& plane, double rounding);

/// Divides a polygon across its longest diagonal, in the middle.
CutPolygon halved(const FacePolygon& polygon, double rounding);

/// The mean of the corners. It lies in the polygon, to rounding.
Vec3 middle_of(const FacePolygon& polygon);

/// The largest distance of a corner from a point.
double reach_from(const FacePolygon& polygon, const Vec3& point);

Box3 box_of(const FacePolygon& polygon);

} // namespace abut
