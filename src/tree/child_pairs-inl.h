// Compares the children of one node with those of another, one against eight in SIMD.

// Included once for each target.
#if defined(ABUT_TREE_CHILD_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_TREE_CHILD_PAIRS_INL_H
#undef ABUT_TREE_CHILD_PAIRS_INL_H
#else
#define ABUT_TREE_CHILD_PAIRS_INL_H
#endif

#include "math/lanes-inl.h"
#include "tree/node_pair-inl.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Code that does not depend on the SIMD target; compiled once.
#ifndef ABUT_TREE_CHILD_PAIRS_ONCE
#define ABUT_TREE_CHILD_PAIRS_ONCE
namespace abut {

/// Exceeds what underflow takes from a product. Without it, an underflowed product of 0 would make
/// every pair count as within a bound that is nearly 0.
constexpr float kUnderflow = std::numeric_limits<float>::min();

/// What a pass over pairs of boxes computes.
enum class BoxTest : std::uint8_t {
    overlap, ///< whether the boxes overlap, and how deep
    within,  ///< a lower bound of their distance, and whether all their points are within the bound
    nearest, ///< a lower bound of their distance, also along the known direction
    middles, ///< the distance of their centres
};

} // namespace abut
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// The lanes of one node.
using Lanes8 = hn::CappedTag<float, Node::kWidth>;

/// Eight boxes as centres and half extents: [axis][lane].
struct MiddleBoxes {
    HWY_ALIGN float centre[3][Node::kWidth];
    HWY_ALIGN float half[3][Node::kWidth];
};

/// The children of one node of a pair, in the node's own frame and in the other node's.
struct Siblings { // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
    MiddleBoxes own, seen;
    /// How far each child extends along the direction n, in world units: the largest n . x. The
    /// direction points towards the other node. The gap along n between two children is at least
    /// -(advance of one + advance of the other).
    HWY_ALIGN float advance[Node::kWidth];
    std::uint32_t used = 0;                                ///< lanes with a child
    float margin = 0, stretch_sq = 0, most_stretch_sq = 0; ///< of distances in the node's own frame
};

/// A bit for each child that is a leaf. An unused lane counts as a leaf.
HWY_INLINE std::uint32_t leaf_lanes(const Node& node) {
    std::uint32_t lanes = 0;
    for (std::uint32_t i = 0; i < Node::kWidth; ++i)
        lanes |= (node.child[i].is_leaf() ? 1U : 0U) << i;
    return lanes;
}

/// Sets all of `s` but `advance` and the margin and stretches of the node's own frame.
HWY_INLINE void see_children(const Node& node, const FrameMap& to_other, Siblings& s) {
    const Lanes8 d;
    const auto half = hn::Set(d, 0.5F);
    for (std::size_t lane = 0; lane < Node::kWidth; lane += hn::Lanes(d)) {
        hn::Vec<Lanes8> centre[3], extent[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const auto lower = hn::Load(d, node.lower[i] + lane),
                       upper = hn::Load(d, node.upper[i] + lane);
            centre[i] = hn::Mul(half, hn::Add(lower, upper));
            extent[i] = hn::Mul(half, hn::Sub(upper, lower));
            hn::Store(centre[i], d, s.own.centre[i] + lane);
            hn::Store(extent[i], d, s.own.half[i] + lane);
        }
        // Unused lanes hold an empty box.
        s.used |= bits_of(d, hn::Ge(extent[0], hn::Zero(d))) << lane;
        for (std::size_t i = 0; i < 3; ++i) {
            auto c = hn::Set(d, to_other.translation[i]);
            auto h = hn::Zero(d);
            for (std::size_t k = 0; k < 3; ++k) {
                c = hn::MulAdd(hn::Set(d, to_other.linear[k][i]), centre[k], c);
                h = hn::MulAdd(hn::Set(d, to_other.magnitude[k][i]), extent[k], h);
            }
            hn::Store(c, d, s.seen.centre[i] + lane);
            hn::Store(h, d, s.seen.half[i] + lane);
        }
    }
}

HWY_INLINE void take_margins(const FrameMap& to_own, Siblings& s) {
    s.margin = to_own.margin;
    s.stretch_sq = to_own.stretch_sq;
    s.most_stretch_sq = to_own.most_stretch_sq;
}
/// Fills `s` with the children of a node, in the node's own frame and in the other's.
HWY_INLINE void see_children(const Node& node, const FrameMap& to_own, const FrameMap& to_other,
                             Siblings& s) {
    see_children(node, to_other, s);
    take_margins(to_own, s);
}

/// The sums sign n_centre . centre + |n_extent| . extent + margin of eight boxes.
HWY_INLINE void sum_along(const float (&centre)[3][Node::kWidth], const Covector& n_centre,
                          const float (&extent)[3][Node::kWidth], const Covector& n_extent,
                          float sign, float margin, float* result) {
    const Lanes8 d;
    for (std::size_t lane = 0; lane < Node::kWidth; lane += hn::Lanes(d)) {
        auto sum = hn::Set(d, margin);
        for (std::size_t i = 0; i < 3; ++i) {
            sum = hn::MulAdd(hn::Set(d, sign * n_centre[i]), hn::Load(d, centre[i] + lane), sum);
            sum = hn::MulAdd(hn::Set(d, std::abs(n_extent[i])), hn::Load(d, extent[i] + lane), sum);
        }
        hn::Store(sum, d, result + lane);
    }
}

HWY_INLINE float length_1(const Covector& n) {
    return std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
}
/// See Siblings::advance. The margin is that of the box's frame.
HWY_INLINE float advance_of(const Aabb& box, const Covector& n, float margin) {
    float sum = length_1(n) * margin;
    for (std::size_t i = 0; i < 3; ++i)
        sum += 0.5F * (n[i] * (box.upper[i] + box.lower[i]) +
                       std::abs(n[i]) * (box.upper[i] - box.lower[i]));
    return sum;
}
/// The largest advance of some children. Infinite if one is not a number, which excludes nothing.
HWY_INLINE float most_of(const float* advance, std::uint32_t lanes) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    float most = -kInfinity;
    for (const std::uint32_t i : SetBits(lanes))
        most = std::max(most, std::isnan(advance[i]) ? kInfinity : advance[i]);
    return most;
}

/// The children that may be near a box of the other node's frame, tested along its axes.
///
/// In          map: from the children's frame to the box's. box_advance: an upper bound of the
///             box's Siblings::advance, for BoxTest::nearest, and the children's `advance` is set.
template <BoxTest test>
HWY_INLINE std::uint32_t near_box(const Siblings& children, const FrameMap& map, const Aabb& box,
                                  float bound_sq, float box_advance) {
    const Lanes8 d;
    const auto zero = hn::Zero(d), margin = hn::Set(d, map.margin);
    std::uint32_t far = 0;
    for (std::size_t lane = 0; lane < Node::kWidth; lane += hn::Lanes(d)) {
        auto gap_sq = zero;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto c = hn::Load(d, children.seen.centre[i] + lane),
                       h = hn::Load(d, children.seen.half[i] + lane);
            const auto gap = hn::Max(hn::Sub(hn::Set(d, box.lower[i]), hn::Add(c, h)),
                                     hn::Sub(hn::Sub(c, h), hn::Set(d, box.upper[i])));
            const auto certain = hn::Max(zero, hn::Sub(gap, margin));
            gap_sq = test == BoxTest::overlap ? hn::Max(gap_sq, certain)
                                              : hn::MulAdd(certain, certain, gap_sq);
        }
        if constexpr (test == BoxTest::overlap) {
            far |= bits_of(d, hn::Gt(gap_sq, zero)) << lane;
            continue;
        }
        auto lower_sq = hn::Mul(gap_sq, hn::Set(d, map.stretch_sq));
        if constexpr (test == BoxTest::nearest) {
            const auto gap = hn::Max(zero, hn::Neg(hn::Add(hn::Set(d, box_advance),
                                                           hn::Load(d, children.advance + lane))));
            lower_sq = hn::Max(lower_sq, hn::Mul(gap, gap));
        }
        far |= bits_of(d, hn::Gt(lower_sq, hn::Set(d, bound_sq))) << lane;
    }
    return children.used & ~far;
}

/// Results of one child of a node against the eight of the other: a bit for each of the eight.
struct RowOfPairs {
    std::uint32_t near = 0;     ///< the pair may overlap, or may be within the bound
    std::uint32_t accepted = 0; ///< all points of both are within the bound of each other
};

/// Gaps between one box and eight, along the axes of one frame.
template <BoxTest test>
struct AxisGaps {
    hn::Vec<Lanes8> gap_sq;   ///< sum of the certain gaps' squares; for `overlap`, the largest gap
                              ///< itself
    hn::Vec<Lanes8> reach_sq; ///< upper bound of the squared distance of two points; for `middles`,
                              ///< that of the centres

    HWY_INLINE AxisGaps(Lanes8 d, const MiddleBoxes& one, std::size_t i, const MiddleBoxes& others,
                        std::size_t lane, float margin) {
        const auto zero = hn::Zero(d);
        gap_sq = test == BoxTest::overlap ? hn::Set(d, hwy::LowestValue<float>()) : zero;
        reach_sq = hn::Set(d, kUnderflow);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto apart = hn::Abs(
                hn::Sub(hn::Load(d, others.centre[axis] + lane), hn::Set(d, one.centre[axis][i])));
            const auto extents =
                hn::Add(hn::Load(d, others.half[axis] + lane), hn::Set(d, one.half[axis][i]));
            const auto gap = hn::Sub(apart, extents);
            if constexpr (test == BoxTest::overlap) {
                gap_sq = hn::Max(gap_sq, gap);
            } else if constexpr (test == BoxTest::middles) {
                reach_sq = hn::MulAdd(apart, apart, reach_sq);
            } else {
                const auto certain = hn::Max(zero, hn::Sub(gap, hn::Set(d, margin)));
                gap_sq = hn::MulAdd(certain, certain, gap_sq);
            }
            if constexpr (test == BoxTest::within) {
                const auto reach = hn::Add(hn::Add(apart, extents), hn::Set(d, margin));
                reach_sq = hn::MulAdd(reach, reach, reach_sq);
            }
        }
    }
};

/// Compares child i of x with all children of y. Each of the eight entries of `value` receives the
/// squared lower bound of the distance in the world. For `overlap` it is the largest gap, so that
/// the most negative value is the deepest overlap. For `middles` it is the squared distance of the
/// centres. A pair whose bound is not a number is kept.
template <BoxTest test>
HWY_INLINE RowOfPairs compare_row(const Siblings& x, std::size_t i, const Siblings& y,
                                  float bound_sq, float* value) {
    const Lanes8 d;
    RowOfPairs row;
    for (std::size_t lane = 0; lane < Node::kWidth; lane += hn::Lanes(d)) {
        const AxisGaps<test> in_x(d, x.own, i, y.seen, lane, x.margin);
        if constexpr (test == BoxTest::middles) {
            hn::Store(in_x.reach_sq, d, value + lane);
            row.near = y.used;
            continue;
        }
        const AxisGaps<test> in_y(d, x.seen, i, y.own, lane, y.margin);
        if constexpr (test == BoxTest::overlap) {
            const auto gap = hn::Max(hn::Sub(in_x.gap_sq, hn::Set(d, x.margin)),
                                     hn::Sub(in_y.gap_sq, hn::Set(d, y.margin)));
            hn::Store(gap, d, value + lane);
            row.near |= bits_of(d, hn::Not(hn::Gt(gap, hn::Zero(d)))) << lane;
            continue;
        }
        auto lower_sq = hn::Max(hn::Mul(in_x.gap_sq, hn::Set(d, x.stretch_sq)),
                                hn::Mul(in_y.gap_sq, hn::Set(d, y.stretch_sq)));
        if constexpr (test == BoxTest::nearest) {
            const auto gap =
                hn::Max(hn::Zero(d),
                        hn::Neg(hn::Add(hn::Set(d, x.advance[i]), hn::Load(d, y.advance + lane))));
            lower_sq = hn::Max(lower_sq, hn::Mul(gap, gap));
        }
        hn::Store(lower_sq, d, value + lane);
        row.near |= bits_of(d, hn::Not(hn::Gt(lower_sq, hn::Set(d, bound_sq)))) << lane;
        if constexpr (test == BoxTest::within)
            row.accepted |=
                bits_of(d, hn::Le(hn::MulAdd(in_x.reach_sq, hn::Set(d, x.most_stretch_sq),
                                             hn::Set(d, kUnderflow)),
                                  hn::Set(d, bound_sq)))
                << lane;
    }
    row.near &= y.used;
    row.accepted &= y.used;
    return row;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
