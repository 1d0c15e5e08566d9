#pragma once

#include "deform/deformable_data.h"
#include "tree/moving_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// How thick the vertices of a surface are, leaf by leaf. A search widens all boxes by the least
/// thickness of a vertex, and each leaf's box by what its thickest vertex has beyond that. So one
/// thick vertex widens the box of its own leaves, and not those of the whole surface.
class LeafWidths {
public:
    /// No vertex has a thickness.
    LeafWidths() = default;
    /// In: thickness, with an entry for each vertex, finite and at least 0; or empty.
    LeafWidths(const DeformableData& surface, std::span<const double> thickness);

    /// The least thickness of a vertex that a triangle uses.
    [[nodiscard]] double least() const { return least_; }
    /// Whether all of these vertices have the same thickness.
    [[nodiscard]] bool is_uniform() const { return beyond_.empty(); }
    /// Upper bound of the thickness of a leaf's features, beyond the least one.
    [[nodiscard]] float beyond(std::uint32_t leaf) const {
        return is_uniform() ? 0 : beyond_[leaf];
    }
    /// A copy of the surface's hierarchy in which each leaf's box at one end is wider by `beyond`.
    ///
    /// Cost        O(n) for n leaves. An inner node's box encloses those of its children, so that
    ///             it is not wider than its own vertices need.
    [[nodiscard]] MovingTree widened(const DeformableData& surface, StepEnd end) const;

private:
    double least_ = 0;
    std::vector<float> beyond_; ///< for each leaf; empty if all are 0
};

/// The margin for leaves that have nothing beyond the least thickness: the distance, and the least
/// thickness on both sides. Limits are sums in double precision, in any order: none of their
/// roundings exceeds the margin and what the leaves have beyond it.
float least_margin(const LeafWidths& a, const LeafWidths& b, double distance);
/// Upper bound of a margin plus what two leaves have beyond it.
float widened_margin(float margin, float beyond_a, float beyond_b);

} // namespace abut
