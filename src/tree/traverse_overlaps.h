#pragma once

#include "tree/moving_tree.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// Called for each pair of leaves whose boxes overlap.
class OverlapVisitor {
public:
    OverlapVisitor() = default;
    OverlapVisitor(const OverlapVisitor&) = delete;
    OverlapVisitor& operator=(const OverlapVisitor&) = delete;
    virtual ~OverlapVisitor() = default;

    /// In: the leaves' numbers. Returns false to stop.
    virtual bool visit(std::uint32_t a, std::uint32_t b) = 0;
};

/// A traversal of two trees, or of one tree against itself. In the latter case each unordered pair
/// of leaves is visited once, and so is each leaf with itself.
struct OverlapTraversal {
    const MovingTree& a;
    const MovingTree& b;
    float margin = 0; ///< boxes this near each other count as overlapping
    /// For a tree against itself, by node: not 0 if the leaves below the node are not to be visited
    /// with each other. May be empty.
    std::span<const std::uint8_t> skipped{};
    /// If it is set, the boxes at that end of the motion are compared, not those of the motion.
    std::optional<StepEnd> at{};

    /// Two children, given by their names.
    struct Pair {
        std::uint32_t a = kRootName, b = kRootName;
    };
    [[nodiscard]] bool is_self() const { return &a == &b; }
};

/// Splits a traversal into tasks: pairs of children such that each overlap lies below exactly one
/// of them. Returns about `wanted` pairs, if there are as many.
std::vector<OverlapTraversal::Pair> split_overlaps(const OverlapTraversal& traversal,
                                                   std::size_t wanted);

/// Visits the pairs of leaves below `start` whose boxes overlap. Returns false if the visitor
/// stopped it.
///
/// Cost        one SIMD pass for a box against eight; no allocation for trees of usual depth.
bool traverse_overlaps(const OverlapTraversal& traversal, OverlapTraversal::Pair start,
                       OverlapVisitor& visitor);

} // namespace abut
