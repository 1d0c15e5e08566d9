#pragma once

#include "volume/sphere.h"
#include "volume/swept_sphere.h"
#include "volume/volume_batch.h"

namespace abut {

struct SsvImage;

/// A swept sphere whose core is a point, a line segment or a rectangle: the kind that bounds its
/// triangles best for the cost of its tests. A hierarchy of these volumes is a hybrid of PSS, LSS
/// and RSS.
///
/// It is stored as a rectangle swept sphere. A segment has one zero side, a point has two.
struct Ssv : Rss {
    using Image = SsvImage;

    Ssv() = default;
    /// Makes the same set of points, stored as a rectangle swept sphere.
    template <std::size_t dimension>
    explicit Ssv(const SweptSphere<dimension>& swept) {
        centre = swept.centre;
        radius = swept.radius;
        for (std::size_t i = 0; i < dimension; ++i)
            axes[i] = {swept.axes[i].direction, swept.axes[i].half};
    }

    /// In          at least one triangle, finite; each coordinate may be off by `margin`.
    /// Accuracy    encloses the triangles, as the three kinds do.
    /// Source      [Larsen et al. 1999]. Differs: the rule of `cheapest`.
    static Ssv fit(std::span<const Triangle> triangles, double margin = 0);

    /// Encloses both volumes.
    static Ssv merge(const Ssv& a, const Ssv& b);

    /// 0: a point, 1: a segment, 2: a rectangle.
    [[nodiscard]] std::size_t dimension() const {
        return axes[1].half > 0 ? 2 : axes[0].half > 0 ? 1 : 0;
    }
};

/// Chooses among three volumes of the same triangles: the one with the least
///
///     cost of a test + 300 * measure / least measure of the three,
///
/// where tests of two points, two segments and two rectangles cost 1, 3 and 30.
///
/// The measure of a volume is that of the relative placements at which it meets a copy of itself
/// [Santalo 1976]. It is proportional to how often a pair of such volumes has to be opened. With
/// the volume V, surface S and integral of mean curvature M, it is 2 V + S M / (2 pi).
Ssv cheapest(const Pss& point, const Lss& segment, const Rss& rectangle);

/// The volume in another frame. Only the first `dimension` axes are set.
struct SsvImage : SweptSphereImage<2> {
    std::size_t dimension = 0;
};
SsvImage image_of(const Ssv& volume, const RelativePose& pose);

/// Eight swept spheres in SIMD order: the rows of a VolumeBatch of Pss, Lss, Rss, BoundingSphere or
/// Ssv. They begin alike; a batch of segments has twice the rows of a batch of points.
struct SweptBatch {
    const float (*row)[VolumeBatch<Ssv>::kLanes];
    std::size_t most_dimension; ///< of a core; each core may have less
};

} // namespace abut
