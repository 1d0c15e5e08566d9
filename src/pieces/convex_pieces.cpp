#include <abut/convex_pieces.h>

#include "pieces/pieces_data.h"

namespace abut {

ConvexPieces::ConvexPieces(const Model& model)
    : data_(std::make_shared<const ConvexPiecesData>(model)) {}

std::size_t ConvexPieces::size() const noexcept {
    return data_->size();
}

std::span<const std::uint32_t> ConvexPieces::triangles(std::size_t piece) const {
    return data_->triangles_of(piece);
}

Convex ConvexPieces::hull(std::size_t piece) const {
    std::vector<Vec3> points;
    for (const HullVertex& v : data_->tree.nodes[data_->tree.leaf_of[piece]].hull.vertices)
        points.push_back(v.at);
    return Convex(points);
}

const Model& ConvexPieces::model() const noexcept {
    return data_->model;
}

std::size_t ConvexPieces::bytes() const noexcept {
    return data_->bytes();
}

} // namespace abut
