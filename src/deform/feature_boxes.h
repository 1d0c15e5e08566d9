#pragma once

#include "mesh/surface_features.h"
#include "volume/moving_box.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace abut {

/// The moving boxes of all features of a surface, by the features' numbers. For searches that take
/// triangle pairs one by one; leaves of a hierarchy have boxes of their own (leaf_features.h).
struct FeatureBoxes {
    std::vector<MovingBox> vertices, edges, faces;

    FeatureBoxes() = default;
    /// In: the vertices' boxes; edges without vertices (kNoEdge) get empty boxes.
    ///
    /// Cost        O(n), parallel.
    FeatureBoxes(std::vector<MovingBox> vertex_boxes,
                 std::span<const std::array<std::uint32_t, 2>> edge_ends,
                 std::span<const IndexTriangle> triangles);

    [[nodiscard]] std::size_t bytes() const {
        return (vertices.size() + edges.size() + faces.size()) * sizeof(MovingBox);
    }
};

/// Whether, along some axis, one box lies farther than a margin below the other at both ends of the
/// motion. Conservative: a rounded difference is below a float only if the exact difference is.
inline bool are_apart(const MovingBox& a, const MovingBox& b, float margin) {
    float overlap = std::numeric_limits<float>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float below = std::max(a.start.upper[axis] - b.start.lower[axis],
                                     a.end.upper[axis] - b.end.lower[axis]);
        const float above = std::max(b.start.upper[axis] - a.start.lower[axis],
                                     b.end.upper[axis] - a.end.lower[axis]);
        overlap = std::min(overlap, std::min(below, above));
    }
    return overlap < -margin;
}

} // namespace abut
