#pragma once

#include "math/vector.h"
#include "volume/fit/principal_axes.h"
#include "volume/relative_pose.h"

#include <array>
#include <span>
#include <vector>

namespace abut {

/// A ball in double precision. Swept spheres are fitted to balls.
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
    static constexpr std::size_t kFloats = 4 + 4 * dimension;
    using Map = RelativePose;
    using Image = SweptSphereImage<dimension>;

    struct Axis {
        std::array<float, 3> direction{}; ///< unit length to rounding
        float half = 0;
    };
    std::array<float, 3> centre{};
    float radius = 0;
    std::array<Axis, dimension> axes{}; ///< orthogonal up to rounding

    /// In          at least one triangle, finite; each coordinate may be off by `margin`.
    /// Accuracy    encloses the triangles: the radius is the largest distance of a vertex from the
    ///             stored core, rounded up.
    /// Source      [Larsen et al. 1999]. Differs: axes from the convex hull; the core of a PSS is
    ///             the middle of the extents.
    static SweptSphere fit(std::span<const Triangle> triangles, double margin = 0);

    /// Encloses both volumes.
    static SweptSphere merge(const SweptSphere& a, const SweptSphere& b);

    /// Upper bound of the distance of the volume's points from the frame's origin.
    [[nodiscard]] double reach() const;
    /// Upper bound of the distance of the volume's points from its centre.
    [[nodiscard]] float circumradius() const;
};

using Pss = SweptSphere<0>;
using Lss = SweptSphere<1>;
using Rss = SweptSphere<2>;

extern template struct SweptSphere<0>;
extern template struct SweptSphere<1>;
extern template struct SweptSphere<2>;

/// A ball around each vertex. In: each coordinate may be off by `margin`.
std::vector<Ball> vertex_balls(std::span<const Triangle> triangles, double margin);

/// A swept sphere that encloses the balls. Its core lies along the first of the axes, in the order
/// of the balls' extents.
///
/// In          at least one ball. Instantiated for all three dimensions.
template <std::size_t dimension>
SweptSphere<dimension> fit_balls(std::span<const Ball> balls, const Axes& axes);

/// Adds the balls whose convex hull is the volume.
template <std::size_t dimension>
void add_corners(const SweptSphere<dimension>& swept, std::vector<Ball>& balls);

/// A swept sphere in another frame. If the pose is not rigid, a rectangle may become a
/// parallelogram. The ball may become an ellipsoid, whose largest radius is then used.
template <std::size_t dimension>
struct SweptSphereImage {
    SweptSphere<dimension> swept;
    /// Vectors in the core's plane with dual_i . direction_k = 1 if i = k, else 0.
    std::array<std::array<float, 3>, dimension> dual{};
    bool is_slanted = false; ///< the directions are not at right angles, even to rounding
    float circumradius = 0;  ///< upper bound of a point's distance from the centre
    float margin = 0;
};

template <std::size_t dimension>
SweptSphereImage<dimension> image_of(const SweptSphere<dimension>& volume,
                                     const RelativePose& pose);

} // namespace abut
