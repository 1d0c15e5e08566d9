#pragma once

#include "geometry/point_triangle_distance.h"
#include "math/predicates.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace abut {

/// A triangle prepared for many points: how far they are, and on which side they lie.
///
/// Accuracy    distance_sq() and nearest() have the bits of nearest_on_triangle(), and side() is
///             orient3d(): what depends on the triangle alone is computed once.
class PreparedTriangle {
public:
    PreparedTriangle() = default;
    explicit PreparedTriangle(const Triangle& t);

    [[nodiscard]] const Triangle& corners() const { return corners_; }

    [[nodiscard]] double distance_sq(const Vec3& p) const { return nearest_feature(p).distance_sq; }
    /// As point_triangle_distance().
    [[nodiscard]] ClosestPoints nearest(const Vec3& p) const;

    /// The sign of orient3d(corners 0, 1, 2, p).
    [[nodiscard]] int side(const Vec3& p) const {
        const Vec3 from = p - corners_[first_];
        const double height = dot(normal_, from), error = rounding_ * sum_of_sizes(from) + kTiny;
        // Overflow makes the error infinite or not a number; then both comparisons are false.
        if (height > error)
            return 1;
        return -height > error ? -1 : orient3d(corners_[0], corners_[1], corners_[2], p);
    }

private:
    /// Far above what a product loses to underflow: in the normal, before a point's height scales
    /// it, and in the height.
    static constexpr double kTiny = 0x1p-960;

    struct Found {
        double distance_sq;
        std::uint8_t dimension = 0; ///< of the feature: 0 vertex, 1 edge, 2 face
        std::uint8_t index = 0;     ///< the vertex, or the edge from vertex i to i + 1
        double s = 0, t = 0;        ///< of the edge; of both vectors of the face
    };
    [[nodiscard]] Found nearest_feature(const Vec3& p) const;

    Triangle corners_{};
    std::array<Vec3, 3> edges_{};        ///< from corner i to the next
    std::array<double, 3> lengths_sq_{}; ///< of the edges
    std::uint32_t first_ = 0;            ///< the longest edge begins at this corner
    Vec3 other_;                         ///< from there to the corner that the longest edge misses
    Vec3 normal_;                        ///< the longest edge times `other_`
    double normal_sq_ = 0;
    double rounding_ =
        0; ///< bounds the error of a height of a point, by the sum of its coordinates
};

// The comparisons and sums are those of nearest_on_triangle and foot_on, in their order.
inline PreparedTriangle::Found PreparedTriangle::nearest_feature(const Vec3& p) const {
    const std::array<Vec3, 3> w{p - corners_[0], p - corners_[1], p - corners_[2]};
    Found best{length_sq(w[0])};
    for (std::uint8_t i = 1; i < 3; ++i)
        if (const double sq = length_sq(w[i]); sq < best.distance_sq)
            best.distance_sq = sq, best.index = i;
    for (std::uint8_t i = 0; i < 3; ++i) {
        const double along = dot(w[i], edges_[i]);
        if (!(along > 0 && along < lengths_sq_[i]))
            continue;
        const double s = along / lengths_sq_[i];
        if (const double sq = length_sq(w[i] - s * edges_[i]); sq < best.distance_sq)
            best = {sq, 1, i, s};
    }
    const Vec3 &u = edges_[first_], &from = w[first_];
    const double along = dot(cross(u, from), normal_);
    if (!(normal_sq_ > 0 && along >= 0 && along <= normal_sq_))
        return best;
    const double h = along / normal_sq_, g = dot(from - h * other_, u) / lengths_sq_[first_];
    if (!(g >= 0 && g + h <= 1))
        return best;
    if (const double sq = length_sq(from - (g * u + h * other_)); sq < best.distance_sq)
        best = {sq, 2, 0, g, h};
    return best;
}

} // namespace abut
