#pragma once

#include "tree/moving_tree.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// What a traversal does where the boxes of two leaves overlap.
class OverlapVisitor {
public:
    OverlapVisitor() = default;
    OverlapVisitor(const OverlapVisitor&) = delete;
    OverlapVisitor& operator=(const OverlapVisitor&) = delete;
    virtual ~OverlapVisitor() = default;

    /// In: the leaves' numbers. False: stop.
    virtual bool visit(std::uint32_t a, std::uint32_t b) = 0;
};

/// Two trees, or one against itself: then each unordered pair of its leaves is visited once, and each
/// leaf with itself.
struct OverlapTraversal {
    const MovingTree& a;
    const MovingTree& b;
    float margin = 0; ///< boxes that come so near overlap
    /// By node of the one tree: not 0 where leaves below are not visited with each other. May be
    /// empty.
    std::span<const std::uint8_t> skipped{};

    /// Two children by their names.
    struct Pair {
        std::uint32_t a = kRootName, b = kRootName;
    };
    [[nodiscard]] bool is_self() const { return &a == &b; }
};

/// Pairs of children below which all overlaps are, each in one of them; some `wanted`, if there are
/// as many: the work of as many tasks.
std::vector<OverlapTraversal::Pair> split_overlaps(const OverlapTraversal& traversal,
                                                   std::size_t wanted);

/// Visits the pairs of leaves below `start` whose boxes overlap. False if the visitor stopped it.
///
/// Cost        one SIMD pass for a box against eight; no allocation for trees of usual depth.
bool traverse_overlaps(const OverlapTraversal& traversal, OverlapTraversal::Pair start,
                       OverlapVisitor& visitor);

} // namespace abut
