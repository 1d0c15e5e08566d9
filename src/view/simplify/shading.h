#pragma once

#include "view/simplify/triangle_search.h"

#include <array>
#include <limits>
#include <span>
#include <vector>

namespace abut {

/// Triangles with the unit normals that they are shaded by.
struct ShadedTriangles {
    std::vector<Triangle> triangles;
    std::vector<std::array<Vec3, 3>> normals; ///< by triangle and corner

    [[nodiscard]] std::size_t size() const { return triangles.size(); }
};

/// The error of a surface that is shown in place of another one, because of its shade: half of the
/// side of a square as large as the area that an eye sees in another shade. So where a ball with
/// this radius is one pixel wide, one pixel has another shade.
///
/// In          surface: the exact one; shown: what is shown in its place, with its search; least: an
///             error that does no harm: a smaller one is returned as 0; most: a larger one is
///             returned as some number above it.
/// Accuracy    not bounded: normals are compared at the middle of each triangle of the surface, and
///             a quarter of an area is taken to be seen at once. A normal and its opposite are
///             equal, as surfaces are shaded from both sides.
/// Cost        O(n log m) for n triangles, of which m are shown.
double shading_error(const ShadedTriangles& surface, const ShadedTriangles& shown,
                     const TriangleSearch& search, double least,
                     double most = std::numeric_limits<double>::infinity());

} // namespace abut
