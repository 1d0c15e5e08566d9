#pragma once

#include <abut/elementary_impact.h>

#include <array>

namespace abut {

/// The distance of two features, with bounds.
struct FeatureDistance {
    double distance = 0;                 ///< of the closest points, between `lower` and `upper`
    double distance_sq = 0;              ///< its square; 0 if that underflows
    double lower = 0, upper = 0;         ///< certified bounds of the distance, as lengths
    std::array<double, 3> barycentric{}; ///< of the closest points, as in ElementaryImpact
    /// Unit vector from the first feature to the second, along which they are at least `lower`
    /// apart. Zero if `lower` is.
    Vec3 direction;
};

/// Distance of a vertex and a face, or of two edges, at rest.
///
/// In          the four points in the order of ElementaryPair, finite.
/// Degenerate  faces and edges without extent act as segments or points. If there are many closest
///             points, one pair of them is returned.
/// Accuracy    `lower` and `upper` are certified for coordinates of any size: a caller that must
///             miss no pair within d tests lower <= d. In all tests, needles and nearly parallel
///             edges included, they differ by less than 1e-12 of the largest coordinate of a vector
///             between two of the points.
/// Cost        some 110 to 170 ns.
FeatureDistance feature_distance(ElementaryKind kind, const std::array<Vec3, 4>& points);

/// A unit vector perpendicular to a face, on the side from which its vertices run counter-clockwise;
/// of two edges, the direction of their cross product.
///
/// Degenerate  a face without area and parallel edges: perpendicular to their line. If all points
///             coincide: any unit vector.
/// Accuracy    to rounding, needles and nearly parallel edges included.
Vec3 common_normal(ElementaryKind kind, const std::array<Vec3, 4>& points);

/// Returns whether two features are at most `distance` apart.
///
/// In          the points and their feature_distance; a finite distance of at least 0.
/// Accuracy    exact: the certified bounds decide, or else exact arithmetic.
/// Cost        some microseconds if the bounds do not decide.
bool are_within(ElementaryKind kind, const std::array<Vec3, 4>& points,
                const FeatureDistance& known, double distance);

} // namespace abut
