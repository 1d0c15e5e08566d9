#include <abut/compound.h>
#include <abut/error.h>

#include "core/arguments.h"
#include "math/transform.h"
#include "rigid/shapes/shape_arguments.h"
#include "world/queries/compound_data.h"
#include "world/queries/rigid_shape_data.h"

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace abut {

namespace {

std::vector<Vec3> moved(const std::vector<Vec3>& points, const Transform& to) {
    std::vector<Vec3> result;
    result.reserve(points.size());
    for (const Vec3& p : points)
        result.push_back(apply(to, p));
    return result;
}

/// A shape as it lies under a rotation and translation.
struct InPlace {
    const Transform& to;

    BodyShape operator()(const Model& model) const {
        Mesh mesh = model.mesh();
        mesh.positions = moved(mesh.positions, to);
        return Model(std::move(mesh));
    }
    BodyShape operator()(const ConvexShape& convex) const {
        return shape_of(Convex(moved(convex.solid.vertices(), to)));
    }
    BodyShape operator()(const RoundedBox& box) const { return placed(box, to); }
    BodyShape operator()(const CurvedShape& curved) const {
        return CurvedShape{placed(curved, to)};
    }
    BodyShape operator()(const PlaneShape& plane) const { return placed(plane, to); }
    BodyShape operator()(const DeformableShape& surface) const {
        return surface;
    } // is no rigid shape
};

BodyShape in_place(const Compound::Piece& piece) {
    require_point(piece.pose.translation, "position");
    const Transform to = piece.pose;
    const BodyShape& shape = piece.shape.data().shape;
    return to == Transform() ? shape : std::visit(InPlace{to}, shape);
}

} // namespace

Compound::Compound(std::span<const Piece> pieces) {
    require(!pieces.empty(), "a compound needs at least one piece");
    CompoundData data;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        try {
            data.pieces.push_back(in_place(pieces[i]));
        } catch (const Error& error) {
            throw Error(error.code(), "piece " + std::to_string(i) + ": " + error.what());
        }
    data_ = std::make_shared<const CompoundData>(std::move(data));
}

Compound::Compound(const ConvexPieces& solid) {
    require(solid.size() > 0, "a compound needs at least one piece");
    CompoundData data;
    for (std::size_t i = 0; i < solid.size(); ++i)
        data.pieces.push_back(shape_of(solid.hull(i)));
    data_ = std::make_shared<const CompoundData>(std::move(data));
}

std::size_t Compound::size() const noexcept {
    return data_->pieces.size();
}

} // namespace abut
