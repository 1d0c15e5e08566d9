#pragma once

#include <abut/elementary_impact.h>

#include "math/vector.h"

#include <array>
#include <cstddef>

/// The set of all differences of a point of the second feature and a point of the first: their
/// Minkowski difference. At each time it is a flat patch
///
///     corner + x side_x + y side_y
///
/// vertex_face: the patch is a triangle, x, y >= 0 and x + y <= 1. Its corners are the face's
/// vertices relative to the vertex. The weights of a point are 1 - x - y, x, y.
/// edge_edge: the patch is a parallelogram. x and y in [0, 1] are the parameters along the first
/// and the second edge.
///
/// The features share a point exactly when the patch holds the origin. All vertices move linearly,
/// so both kinds of test ask the same question: when does the patch pass over the origin?
namespace abut {

/// A vector, as the difference of two of a pair's four vertices.
struct VertexDifference {
    std::size_t from, to;
};

/// The vertex differences that span a patch.
struct PatchLayout {
    VertexDifference corner, side_x, side_y;
    std::size_t corners; ///< number of the patch's corners
};

constexpr PatchLayout patch_layout(ElementaryKind kind) {
    return kind == ElementaryKind::vertex_face ? PatchLayout{{0, 1}, {1, 2}, {1, 3}, 3}
                                               : PatchLayout{{0, 2}, {1, 0}, {2, 3}, 4};
}

/// x and y of a patch's corners, in order around the patch.
constexpr std::array<std::array<double, 2>, 4> patch_corners(ElementaryKind kind) {
    return kind == ElementaryKind::vertex_face
               ? std::array<std::array<double, 2>, 4>{{{0, 0}, {1, 0}, {0, 1}, {0, 0}}}
               : std::array<std::array<double, 2>, 4>{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

/// Converts x and y of the patch's point at the origin to the features' barycentric coordinates. x
/// and y are clamped to the patch first.
std::array<double, 3> patch_barycentric(ElementaryKind kind, double x, double y);

/// The unit vector of `direction`, turned to the side that ElementaryImpact::normal names.
///
/// In          barycentric, direction, line: at the time and place of impact. If `direction` is
///             zero, the relative velocity's part perpendicular to `line` (the line of a degenerate
///             patch) is used.
Vec3 impact_normal(const ElementaryPair& pair, const std::array<double, 3>& barycentric,
                   const Vec3& direction, const Vec3& line);

} // namespace abut
