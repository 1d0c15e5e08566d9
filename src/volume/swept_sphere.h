#pragma once

#include "math/vector.h"
#include "volume/relative_pose.h"

#include <array>
#include <span>

namespace abut {

/// A ball: in double precision what a swept sphere encloses.
struct Ball {
    Vec3 centre;
    double radius = 0;
};

template <std::size_t dimension>
struct SweptSphereImage;

/// All points within `radius` of a core: a point (PSS), a line segment (LSS) or a rectangle (RSS),
///
///     { centre + sum_i s_i direction_i : |s_i| <= half_i }.
///
/// The volume is that of the exact values of its floats, as everywhere in this folder.
template <std::size_t dimension>
struct SweptSphere {
    static constexpr std::size_t kDimension = dimension;
    static constexpr std::size_t kFloats = 4 + 4 * dimension;
    using Map = RelativePose;
    using Image = SweptSphereImage<dimension>;

    struct Axis {
        std::array<float, 3> direction{}; ///< unit length to rounding
        float half = 0;
    };
    std::array<float, 3> centre{};
    float radius = 0;
    std::array<Axis, dimension> axes{}; ///< at right angles to rounding

    /// In          at least one triangle, finite; each coordinate may be off by `margin`.
    /// Accuracy    encloses the triangles: the radius is the largest distance of a vertex from the
    ///             core as it is stored, rounded up.
    /// Source      [Larsen et al. 1999]. Differs: axes from the convex hull; the point is the
    ///             middle of the extents.
    static SweptSphere fit(std::span<const Triangle> triangles, double margin = 0);

    /// Encloses both.
    static SweptSphere merge(const SweptSphere& a, const SweptSphere& b);

    /// No point of the volume is farther from the frame's origin.
    [[nodiscard]] double reach() const;
    /// No point of the volume is farther from its centre.
    [[nodiscard]] float circumradius() const;
};

using Pss = SweptSphere<0>;
using Lss = SweptSphere<1>;
using Rss = SweptSphere<2>;

extern template struct SweptSphere<0>;
extern template struct SweptSphere<1>;
extern template struct SweptSphere<2>;

/// A swept sphere seen from another frame. If the pose is not rigid, the rectangle may have become
/// a parallelogram, and the radius stands for the largest of the ellipsoid.
template <std::size_t dimension>
struct SweptSphereImage {
    SweptSphere<dimension> swept;
    /// Vectors of the core's plane with dual_i . direction_k = 1 if i = k, else 0.
    std::array<std::array<float, 3>, dimension> dual{};
    float circumradius = 0; ///< no point is farther from the centre
    float margin = 0;
};

template <std::size_t dimension>
SweptSphereImage<dimension> image_of(const SweptSphere<dimension>& volume,
                                     const RelativePose& pose);

} // namespace abut
