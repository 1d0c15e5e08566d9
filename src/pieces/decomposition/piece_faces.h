#pragma once

#include <abut/types.h>

#include "convex/hull/polytope.h"
#include "convex/search/voronoi_marching.h"
#include "math/vector.h"
#include "pieces/decomposition/surface_graph.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Which triangles of the surface lie in each face of a piece's hull: so that a feature of the hull
/// leads to one of the surface.
struct PieceFaces {
    std::vector<std::uint32_t>
        face_of_edge;                     ///< of the hull: the flat face on the left of each edge
    std::vector<std::uint32_t> begin;     ///< of each face's run in `triangles`, and the end
    std::vector<std::uint32_t> triangles; ///< by face; none where the hull covers a gap

    [[nodiscard]] std::span<const std::uint32_t> in(std::uint32_t face) const {
        return std::span(triangles).subspan(begin[face], begin[face + 1] - begin[face]);
    }
};

/// In          the hull of a piece, which of the surface's positions its vertices are, and the
///             piece's triangles.
PieceFaces find_piece_faces(const SurfaceGraph& surface, const Polytope& hull,
                            std::span<const std::uint32_t> source,
                            std::span<const std::uint32_t> triangles);

} // namespace abut
