#pragma once

#include <abut/elementary_impact.h>

#include "math/vector.h"

#include <array>
#include <cstddef>

/// The set of all differences of a point of the second feature and one of the first (their
/// Minkowski difference): at each time a flat patch
///
///     corner + x side_x + y side_y
///
/// vertex_face: a triangle, x, y >= 0 and x + y <= 1, its corners the face's vertices as seen from
/// the vertex; the weights of a point are 1 - x - y, x, y. edge_edge: a parallelogram, x and y
/// in [0, 1] the parameters along the first and the second edge. The features share a point where
/// the patch holds the origin. Everything moves linearly, so both kinds of test are one: when does
/// the patch pass over the origin?
namespace abut {

/// A vector as the difference of two of a pair's four vertices.
struct VertexDifference {
    std::size_t from, to;
};

/// Which differences make a patch.
struct PatchLayout {
    VertexDifference corner, side_x, side_y;
    std::size_t corners; ///< of the patch
};

constexpr PatchLayout patch_layout(ElementaryKind kind) {
    return kind == ElementaryKind::vertex_face ? PatchLayout{{0, 1}, {1, 2}, {1, 3}, 3}
                                               : PatchLayout{{0, 2}, {1, 0}, {2, 3}, 4};
}

/// x and y of a patch's corners, in order around it.
constexpr std::array<std::array<double, 2>, 4> patch_corners(ElementaryKind kind) {
    return kind == ElementaryKind::vertex_face
               ? std::array<std::array<double, 2>, 4>{{{0, 0}, {1, 0}, {0, 1}, {0, 0}}}
               : std::array<std::array<double, 2>, 4>{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

/// x and y of the point of a patch that lies at the origin, as barycentric coordinates of features;
/// clamped to the patch.
std::array<double, 3> patch_barycentric(ElementaryKind kind, double x, double y);

/// The unit vector of `direction`, on the side that ElementaryImpact::normal names.
///
/// In          at the time and place of impact; a direction of zero leaves the relative
///             velocity's part across `line` (the patch's, if it is degenerate).
Vec3 impact_normal(const ElementaryPair& pair, const std::array<double, 3>& barycentric,
                   const Vec3& direction, const Vec3& line);

} // namespace abut
