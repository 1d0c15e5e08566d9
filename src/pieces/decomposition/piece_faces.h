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

/// The triangles of the surface that lie in each face of a piece's hull. They lead from a feature
/// of the hull to one of the surface.
struct PieceFaces {
    std::vector<std::uint32_t> face_of_edge; ///< by edge of the hull: the face on its left
    std::vector<std::uint32_t> begin;        ///< of each face's run in `triangles`, and the end
    std::vector<std::uint32_t> triangles;    ///< by face; none where the hull covers a gap

    [[nodiscard]] std::span<const std::uint32_t> in(std::uint32_t face) const {
        return std::span(triangles).subspan(begin[face], begin[face + 1] - begin[face]);
    }
};

/// In          the hull of a piece, the numbers of its vertices' positions, and the piece's
///             triangles.
PieceFaces find_piece_faces(const SurfaceGraph& surface, const Polytope& hull,
                            std::span<const std::uint32_t> source,
                            std::span<const std::uint32_t> triangles);

} // namespace abut
