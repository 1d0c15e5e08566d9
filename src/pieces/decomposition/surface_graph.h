#pragma once

#include <abut/mesh.h>

#include "math/vector.h"
#include "mesh/surface_features.h"
#include "rigid/model/solid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The triangles of a closed surface, with their neighbours. Equal positions count as one vertex,
/// the first of them.
///
/// Refers to the mesh.
struct SurfaceGraph {
    /// In          solid: of the mesh. The triangles that it drops have no neighbours. Where more
    ///             than two triangles share an edge, those that enclose matter are neighbours.
    /// Errors      Error{bad_mesh} naming an edge: it is open, or its triangles run in one
    ///             direction more often than in the other; or no triangle has three different
    ///             corners.
    SurfaceGraph(const Mesh& mesh, const Solid& solid);

    [[nodiscard]] Triangle triangle(std::uint32_t t) const {
        const IndexTriangle& c = corners[t];
        return {positions[c[0]], positions[c[1]], positions[c[2]]};
    }
    /// Returns whether a triangle has no area. Exact.
    [[nodiscard]] bool is_degenerate(std::uint32_t t) const;

    std::span<const Vec3> positions;
    std::vector<IndexTriangle> corners;
    /// across[t][k]: the triangle beyond the edge from corner k; kNoEdge if two corners are one
    /// vertex, or if the triangle is dropped.
    std::vector<IndexTriangle> across;
};

} // namespace abut
