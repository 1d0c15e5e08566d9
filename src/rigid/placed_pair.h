#pragma once

#include <abut/model.h>
#include <abut/rigid.h>

#include "geometry/triangle_block.h"
#include "rigid/model_data.h"
#include "tree/traverse_pair.h"

#include <optional>

namespace abut {

/// Two models under their transforms, ready for a traversal.
class PlacedPair {
public:
    /// A transform without an inverse (a flattened part) is applied to a copy of the mesh first.
    ///
    /// Errors      Error{bad_argument} if a transform is not finite; Error{bad_mesh} if such a copy
    ///             has positions out of range.
    PlacedPair(const Model& a, const Transform& world_from_a, const Model& b,
               const Transform& world_from_b);

    [[nodiscard]] const ModelData& a() const { return a_.data(); }
    [[nodiscard]] const ModelData& b() const { return b_.data(); }
    [[nodiscard]] const Transform& world_from_a() const { return world_from_a_; }
    [[nodiscard]] const Transform& world_from_b() const { return world_from_b_; }
    [[nodiscard]] PairTraversal traversal(double bound_sq) const {
        return {a().tree(), b().tree(), frame_, bound_sq};
    }

private:
    Model a_, b_;
    Transform world_from_a_, world_from_b_;
    PairFrame frame_;
};

/// The world triangles of two leaves, fetched only when a leaf changes.
class LeafTriangles {
public:
    explicit LeafTriangles(const PlacedPair& pair) : pair_(pair) {}

    void fetch(NodeRef leaf_a, NodeRef leaf_b);
    [[nodiscard]] std::uint32_t count_a() const { return count_a_; }
    [[nodiscard]] const Triangle& a(std::uint32_t i) const { return a_[i]; }
    [[nodiscard]] const TriangleBlock& b() const { return b_; }
    /// One bit for each triangle of b.
    [[nodiscard]] std::uint32_t lanes_b() const { return (1U << count_b_) - 1; }
    /// Mesh indices of triangle i of a and of lane j of b.
    [[nodiscard]] TrianglePair indices(std::uint32_t i, std::uint32_t j) const {
        return {pair_.a().triangle_at(first_a_ + i), pair_.b().triangle_at(first_b_ + j)};
    }

private:
    const PlacedPair& pair_;
    std::uint32_t first_a_ = ~0U, first_b_ = ~0U, count_a_ = 0, count_b_ = 0;
    std::array<Triangle, TriangleBlock::kLanes> a_;
    TriangleBlock b_{};
};

/// As the public query, for a pair placed already.
Gap distance(const PlacedPair& pair, double upper_bound);

} // namespace abut
