#pragma once

#include <abut/convex_pieces.h>

#include "pieces/decomposition/piece_faces.h"
#include "pieces/decomposition/surface_graph.h"
#include "pieces/hull_tree.h"
#include "rigid/model/solid.h"

#include <cstdint>
#include <vector>

namespace abut {

/// The data that copies of a ConvexPieces share.
class ConvexPiecesData {
public:
    /// Errors      Error{bad_mesh}.
    explicit ConvexPiecesData(const Model& solid);

    [[nodiscard]] const Mesh& mesh() const { return model.mesh(); }
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::size_t piece) const {
        return std::span(triangles).subspan(begin[piece], begin[piece + 1] - begin[piece]);
    }
    [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
    [[nodiscard]] std::size_t bytes() const;

    Model model;
    std::uint64_t id = 0;                           ///< unique in this process
    std::vector<std::uint32_t> begin{0}, triangles; ///< of each piece
    std::vector<std::uint32_t> piece_of;            ///< by triangle
    HullTree tree;
    std::vector<PieceFaces> faces;          ///< by piece; empty for pieces of few triangles
    std::vector<std::uint32_t> triangle_at; ///< by position: a triangle with that vertex
    std::vector<std::uint32_t> components;  ///< a vertex of each component
    double reach = 0;                       ///< largest |x| + |y| + |z| of a vertex
};

} // namespace abut
