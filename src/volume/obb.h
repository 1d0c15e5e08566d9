#pragma once

#include "volume/fit/principal_axes.h"
#include "volume/relative_pose.h"

#include <array>
#include <span>

namespace abut {

struct ObbImage;

/// Oriented box: { centre + sum_i s_i axis_i : |s_i| <= half_i }.
struct Obb {
    static constexpr std::size_t kFloats = 15;
    using Map = RelativePose;
    using Image = ObbImage;

    std::array<float, 3> centre{};
    std::array<std::array<float, 3>, 3> axis{}; ///< orthonormal to rounding
    std::array<float, 3> half{};

    /// In          at least one triangle, finite; each coordinate may be off by `margin`.
    /// Accuracy    encloses the triangles, in the exact values of the floats.
    /// Source      [Gottschalk, Lin, Manocha 1996]: axes from the surface of the convex hull.
    static Obb fit(std::span<const Triangle> triangles, double margin = 0);

    /// Encloses both boxes: the smallest of three boxes, along a's axes, along b's, and along the
    /// principal axes of all corners.
    static Obb merge(const Obb& a, const Obb& b);

    /// Upper bound of the distance of the volume's points from the frame's origin.
    [[nodiscard]] double reach() const;
    /// Upper bound of the distance of the volume's points from its centre.
    [[nodiscard]] float circumradius() const;
};

/// An oriented box in another frame. It is a parallelepiped if the pose is not rigid.
struct ObbImage {
    std::array<float, 3> centre;
    std::array<std::array<float, 3>, 3> direction; ///< of the edges, unit length
    std::array<float, 3> half;                     ///< half lengths of the edges
    std::array<std::array<float, 3>, 3> normal;    ///< of the faces, unit length
    std::array<float, 3> normal_half;              ///< distances from the centre to the faces
    /// [i][k]: half the length of edge k times |direction_i x direction_k|
    std::array<std::array<float, 3>, 3> half_across;
    float normals_spread; ///< sum_i (normal_i . d)^2 <= spread |d|^2; 1 if rigid
    float circumradius;   ///< upper bound of a point's distance from the centre
    float margin;
};
ObbImage image_of(const Obb& volume, const RelativePose& pose);

} // namespace abut
