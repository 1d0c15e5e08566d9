#pragma once

#include <abut/model.h>
#include <abut/rigid.h>

#include "core/set_bits.h"
#include "geometry/leaf/triangle_leaf.h"
#include "rigid/model/model_data.h"
#include "tree/traverse_volumes.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace abut {

/// Two models under their transforms, prepared for a traversal.
class PlacedPair {
public:
    /// A transform without an inverse (a flattened part) is first applied to a copy of the mesh.
    ///
    /// In          models that outlive the pair.
    /// Errors      Error{bad_argument} if a transform is not finite; Error{bad_mesh} if such a copy
    ///             has positions out of range.
    PlacedPair(const Model& a, const Transform& world_from_a, const Model& b,
               const Transform& world_from_b);

    [[nodiscard]] const ModelData& a() const { return *a_; }
    [[nodiscard]] const ModelData& b() const { return *b_; }
    [[nodiscard]] const Transform& world_from_a() const { return world_from_a_; }
    [[nodiscard]] const Transform& world_from_b() const { return world_from_b_; }
    /// World positions of triangles by their mesh indices.
    [[nodiscard]] Triangle triangle_a(std::uint32_t i) const {
        return a().world_triangle(i, world_from_a_);
    }
    [[nodiscard]] Triangle triangle_b(std::uint32_t i) const {
        return b().world_triangle(i, world_from_b_);
    }
    /// No point of a is farther than this from any point of b.
    [[nodiscard]] double reach() const { return std::sqrt(double{frame_.reach_sq}); }
    /// Returns whether both models have these triangles.
    [[nodiscard]] bool has(const TrianglePair& pair) const {
        return pair.a < a().mesh().triangles.size() && pair.b < b().mesh().triangles.size();
    }
    [[nodiscard]] PairTraversal traversal(double bound_sq) const {
        return {a().tree(), b().tree(), frame_, bound_sq};
    }
    /// The kind of volume that a traversal tests.
    [[nodiscard]] Volume volume() const;
    /// Traverse the models' volumes if their kinds can be compared (common_volume); otherwise their
    /// boxes.
    Verdict visit_contacts(PairTraversal& traversal, LeafPairVisitor& visitor) const;
    Verdict visit_within(PairTraversal& traversal, LeafPairVisitor& visitor) const;
    Verdict visit_nearest(PairTraversal& traversal, LeafPairVisitor& visitor) const;

private:
    void compare_frames();

    const ModelData *a_, *b_;
    std::optional<Model> baked_a_, baked_b_; ///< the transformed copies, if there are any
    Transform world_from_a_, world_from_b_;
    PairFrame frame_;
    VolumeFrame volume_frame_; ///< valid if the models' volumes can be compared
};

/// The world triangles of two leaves, computed on demand.
class LeafTriangles {
public:
    explicit LeafTriangles(const PlacedPair& pair) : pair_(pair) {}

    void set_leaves(NodeRef leaf_a, NodeRef leaf_b) {
        if (leaf_a.first() != first_a_)
            first_a_ = leaf_a.first(), known_a_ = 0;
        if (leaf_b.first() != first_b_)
            first_b_ = leaf_b.first(), known_b_ = 0;
    }
    const Triangle& a(std::uint32_t i) {
        if ((known_a_ >> i & 1U) == 0)
            a_[i] = pair_.a().world_slot(first_a_ + i, pair_.world_from_a());
        known_a_ |= 1U << i;
        return a_[i];
    }
    const Triangle& b(std::uint32_t j) {
        if ((known_b_ >> j & 1U) == 0)
            b_[j] = pair_.b().world_slot(first_b_ + j, pair_.world_from_b());
        known_b_ |= 1U << j;
        return b_[j];
    }
    [[nodiscard]] TrianglePair indices(std::uint32_t i, std::uint32_t j) const {
        return {pair_.a().triangle_at(first_a_ + i), pair_.b().triangle_at(first_b_ + j)};
    }

private:
    const PlacedPair& pair_;
    std::uint32_t first_a_ = ~0U, first_b_ = ~0U, known_a_ = 0, known_b_ = 0;
    std::array<Triangle, TriangleLeaf::kLanes> a_, b_;
};

/// Calls body(i, j) for each pair in a set of LeafPairs until it returns false. Returns whether it
/// never did.
template <typename Body>
bool for_each_pair(std::uint32_t pairs, const Body& body) {
    for (const std::uint32_t bit : SetBits(pairs))
        if (!body(bit / TriangleLeaf::kLanes, bit % TriangleLeaf::kLanes))
            return false;
    return true;
}

/// The public query, for a pair that is already placed.
Gap distance(const PlacedPair& pair, const DistanceOptions& options);

/// The gap of a pair, and its square as the search compared it. They agree to two roundings.
struct MeasuredGap {
    Gap gap;
    double measured_sq = std::numeric_limits<double>::infinity(); ///< infinite if no pair was found
};
/// The nearest two triangles whose squared distance is below the bound; of equally near pairs, the
/// one with the smallest indices. For mesh blocks of larger models: however a mesh is cut, the
/// smallest of all results is the same, to the last bit.
MeasuredGap nearest_gap(const PlacedPair& pair, double bound_sq);

} // namespace abut
