#pragma once

#include "volume/swept_sphere.h"

namespace abut {

/// A ball that is fitted nearly as small as possible. Its representation is that of a point swept
/// sphere.
struct BoundingSphere : Pss {
    BoundingSphere() = default;
    explicit BoundingSphere(const Pss& ball) : Pss(ball) {}

    /// In          at least one triangle, finite; each coordinate may be off by `margin`.
    /// Accuracy    encloses the triangles; the radius is within a few percent of the least.
    /// Source      the exact ball [Welzl 1991] of the vertices that are extreme along 13 directions
    ///             [Larsson 2008], then grown as [Ritter 1990].
    static BoundingSphere fit(std::span<const Triangle> triangles, double margin = 0);

    /// The smallest ball around both, to rounding.
    static BoundingSphere merge(const BoundingSphere& a, const BoundingSphere& b);
};

} // namespace abut
