#include "rigid/motion/moving_nodes.h"

#include "core/set_bits.h"
#include "math/rounding.h"
#include "rigid/motion/node_motion.h"

#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rigid/motion/moving_nodes.cpp"
#include "simd/foreach_target.h"
#include "geometry/leaf/leaf_lanes-inl.h"
#include "tree/child_pairs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Approximate sizes of a child, and of a triangle of a leaf, relative to the node.
constexpr double kChild = 0.5, kTriangle = 0.1;

/// The share of the span in which two sets may meet, in each lane, from their gaps along
/// directions. A value that is not a number excludes nothing.
template <class D>
struct Meeting {
    hn::Vec<D> from, to;

    HWY_INLINE Meeting(D d, float begin) : from(hn::Set(d, begin)), to(hn::Set(d, 1.0F)) {}

    /// The sets are apart as long as gap - s closing > 0.
    HWY_INLINE void take(D d, hn::Vec<D> gap, hn::Vec<D> closing) {
        const auto zero = hn::Zero(d), never = hn::Set(d, std::numeric_limits<float>::infinity());
        const auto share = hn::Div(gap, closing);
        const auto apart = hn::Gt(gap, zero);
        from = hn::Max(
            from, hn::IfThenElseZero(apart, hn::IfThenElse(hn::Gt(closing, zero), share, never)));
        to = hn::Min(to, hn::IfThenElse(hn::AndNot(apart, hn::Lt(closing, zero)), share, never));
    }
    /// A share at or before their first meeting: the difference, quotient and product are rounded.
    [[nodiscard]] HWY_INLINE hn::Vec<D> share(D d) const {
        return hn::Mul(from, hn::Set(d, 1 - 0x1p-20F));
    }
    [[nodiscard]] HWY_INLINE hn::Mask<D> possible(D d) const {
        return hn::Not(hn::Gt(share(d), hn::Mul(to, hn::Set(d, 1 + 0x1p-20F))));
    }
};

/// The share at which the span begins, rounded down.
HWY_INLINE float first_share(const TimeSpan& span) {
    const double length = span.end - span.moment.time;
    return length > 0 ? to_float((1 - 0x1p-20) * (span.begin - span.moment.time) / length) : 0.0F;
}

/// The children of a node, with their motion.
struct MovingSiblings {
    /// Along a frame's axes: the speed of a box's centre, and the bound by which points of it
    /// differ.
    struct Speeds {
        HWY_ALIGN float middle[3][Node::kWidth];
        HWY_ALIGN float more[3][Node::kWidth];
    };
    Siblings boxes;
    Speeds own_speeds, seen_speeds; ///< in the node's own frame, and in the other node's

    HWY_INLINE MovingSiblings(const Node& node, const FrameMap& to_own, const FrameMap& to_other,
                              const NodeMotion& in_own, const NodeMotion& in_other) {
        see_children(node, to_own, to_other, boxes);
        const Lanes8 d;
        for (std::size_t lane = 0; lane < Node::kWidth; lane += hn::Lanes(d)) {
            const Lanes3<Lanes8> half = load3(d, boxes.own.half, lane);
            const auto radius = hn::Sqrt(hn::Add(dot(half, half), hn::Set(d, kUnderflow)));
            measure(in_own.spin_own, {}, in_own.turn_own, {}, load3(d, boxes.own.centre, lane),
                    radius, own_speeds, lane);
            measure(in_other.spin_other, in_other.velocity, in_other.turn_other, in_other.spread,
                    load3(d, boxes.seen.centre, lane),
                    hn::Mul(radius, hn::Set(d, in_other.own_from_other)), seen_speeds, lane);
        }
    }

private:
    static HWY_INLINE void measure(const std::array<float, 3>& spin,
                                   const std::array<float, 3>& velocity,
                                   const std::array<float, 3>& turn,
                                   const std::array<float, 3>& spread, const Lanes3<Lanes8>& centre,
                                   hn::Vec<Lanes8> radius, Speeds& speeds, std::size_t lane) {
        const Lanes8 d;
        const Lanes3<Lanes8> turning = cross(set3(d, spin), centre);
        const hn::Vec<Lanes8> v[3] = {turning.x, turning.y, turning.z};
        for (std::size_t i = 0; i < 3; ++i) {
            hn::Store(hn::Add(v[i], hn::Set(d, velocity[i])), d, speeds.middle[i] + lane);
            hn::Store(hn::MulAdd(radius, hn::Set(d, turn[i]), hn::Set(d, spread[i])), d,
                      speeds.more[i] + lane);
        }
    }
};

/// Compares child i of one node with some of the other's, along the axes of one frame.
HWY_INLINE void compare_along(Lanes8 d, const MiddleBoxes& one,
                              const MovingSiblings::Speeds& one_speeds, std::size_t i,
                              const MiddleBoxes& others, const MovingSiblings::Speeds& other_speeds,
                              std::size_t lane, float margin, Meeting<Lanes8>& meeting) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto offset =
            hn::Sub(hn::Load(d, others.centre[axis] + lane), hn::Set(d, one.centre[axis][i]));
        const auto extent =
            hn::Add(hn::Load(d, others.half[axis] + lane), hn::Set(d, one.half[axis][i] + margin));
        const auto parting = hn::Sub(hn::Load(d, other_speeds.middle[axis] + lane),
                                     hn::Set(d, one_speeds.middle[axis][i]));
        const auto more = hn::Add(hn::Load(d, other_speeds.more[axis] + lane),
                                  hn::Set(d, one_speeds.more[axis][i]));
        meeting.take(d, hn::Sub(offset, extent), hn::Sub(more, parting));
        meeting.take(d, hn::Neg(hn::Add(offset, extent)), hn::Add(more, parting));
    }
}

/// Compares child i of x with all children of y.
HWY_INLINE std::uint32_t meet_row(const MovingSiblings& x, std::size_t i, const MovingSiblings& y,
                                  float begin, float* share) {
    const Lanes8 d;
    std::uint32_t possible = 0;
    for (std::size_t lane = 0; lane < Node::kWidth; lane += hn::Lanes(d)) {
        Meeting<Lanes8> meeting(d, begin);
        compare_along(d, x.boxes.own, x.own_speeds, i, y.boxes.seen, y.seen_speeds, lane,
                      x.boxes.margin, meeting);
        if (hn::AllFalse(d, meeting.possible(d)))
            continue;
        compare_along(d, x.boxes.seen, x.seen_speeds, i, y.boxes.own, y.own_speeds, lane,
                      y.boxes.margin, meeting);
        hn::StoreU(meeting.share(d), d, share + lane);
        possible |= bits_of(d, meeting.possible(d)) << lane;
    }
    return possible & y.boxes.used;
}

void find_meeting_children(const TimeSpan& span, const NodeChildren& a, const NodeChildren& b,
                           MeetingChildren& result) {
    const Moment& now = span.moment;
    NodePair nodes(now.frame, a.node, b.node);
    const double duration = span.end - now.time;
    const NodeMotion in_p = motion_of(now.in_a, duration, a.node, b.node, nodes.p_from_q, kChild),
                     in_q = motion_of(now.in_b, duration, b.node, a.node, nodes.q_from_p, kChild);
    nodes.p_from_q.margin += to_float(now.in_a.margin + now.in_a.radius);
    nodes.q_from_p.margin += to_float(now.in_b.margin + now.in_b.radius);
    const MovingSiblings p(a.node, nodes.p_from_q, nodes.q_from_p, in_p, in_q),
        q(b.node, nodes.q_from_p, nodes.p_from_q, in_q, in_p);
    const float begin = first_share(span);
    result.pairs = 0;
    const std::uint32_t lanes_a = a.lanes & p.boxes.used, lanes_b = b.lanes & q.boxes.used;
    // Each child of the node with fewer children is compared with all of the other's.
    if (std::popcount(lanes_a) <= std::popcount(lanes_b)) {
        for (const std::size_t i : SetBits(lanes_a)) {
            const std::uint64_t row = meet_row(p, i, q, begin, result.share[i]) & lanes_b;
            result.pairs |= row << (Node::kWidth * i);
        }
        return;
    }
    for (const std::size_t j : SetBits(lanes_b)) {
        HWY_ALIGN float column[Node::kWidth];
        for (const std::size_t i : SetBits(meet_row(q, j, p, begin, column) & lanes_a)) {
            result.share[i][j] = column[i];
            result.pairs |= std::uint64_t{1} << (Node::kWidth * i + j);
        }
    }
}

/// Pairs of triangles with their motion, lane by lane.
template <class D>
struct MovingTriangles {
    Lanes3<D> a[3], b[3]; ///< vertices
    Lanes3<D> velocity_a[3], velocity_b[3];
    bool turns = false;

    /// Compares along a direction of any length; margin and spread are scaled by that length. A
    /// triangle stays on its side of a plane while its vertices do.
    HWY_INLINE void take(D d, const Lanes3<D>& n, hn::Vec<D> margin, hn::Vec<D> spread,
                         Meeting<D>& meeting) const {
        const auto heights = [&](const Lanes3<D>(&v)[3], hn::Vec<D>& low,
                                 hn::Vec<D>& high) HWY_ATTR {
            const auto h0 = dot(n, v[0]), h1 = dot(n, v[1]), h2 = dot(n, v[2]);
            low = min3(h0, h1, h2), high = max3(h0, h1, h2);
        };
        hn::Vec<D> low_a, high_a, low_b, high_b, slow_a, fast_a, slow_b, fast_b;
        heights(a, low_a, high_a);
        heights(b, low_b, high_b);
        if (turns) {
            heights(velocity_a, slow_a, fast_a);
            heights(velocity_b, slow_b, fast_b);
        } else {
            slow_a = fast_a = hn::Zero(d);
            slow_b = fast_b = dot(n, velocity_b[0]);
        }
        meeting.take(d, hn::Sub(hn::Sub(low_b, high_a), margin),
                     hn::Add(hn::Sub(fast_a, slow_b), spread));
        meeting.take(d, hn::Sub(hn::Sub(low_a, high_b), margin),
                     hn::Add(hn::Sub(fast_b, slow_a), spread));
    }
};

void find_meeting_triangles(const TimeSpan& span, const Node& node_a, const TriangleLeaf& leaf_a,
                            const Node& node_b, const TriangleLeaf& leaf_b,
                            MeetingTriangles& result) {
    using D = hn::CappedTag<float, kPairs>;
    const D d;
    const FrameMotion& frame = span.moment.in_a;
    FrameMap a_from_b;
    between_nodes(span.moment.frame.a_from_b, node_a, node_b, a_from_b);
    const NodeMotion motion =
        motion_of(frame, span.end - span.moment.time, node_a, node_b, a_from_b, kTriangle);
    TriangleLeaf turned{};
    turn_leaf(leaf_b, a_from_b, turned);
    const float begin = first_share(span);
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F);
    // The vertices are off by two margins in sum, and the heights are rounded.
    const auto margin =
        hn::Set(d, 3 * (a_from_b.margin + to_float(frame.margin)) + to_float(frame.radius));
    result.pairs = 0;
    for (std::size_t lane = 0; lane < kPairs; lane += hn::Lanes(d)) {
        MovingTriangles<D> t;
        load_pairs(d, leaf_a, turned, lane, t.a, t.b);
        t.turns = motion.turns;
        const Lanes3<D> spin_own = set3(d, motion.spin_own),
                        spin_other = set3(d, motion.spin_other),
                        velocity = set3(d, motion.velocity);
        for (std::size_t v = 0; v < 3; ++v) {
            t.velocity_a[v] = cross(spin_own, t.a[v]);
            t.velocity_b[v] = plus_scaled(velocity, one, cross(spin_other, t.b[v]));
        }
        Meeting<D> meeting(d, begin);
        t.take(d, {one, zero, zero}, margin, hn::Set(d, motion.spread[0]), meeting);
        t.take(d, {zero, one, zero}, margin, hn::Set(d, motion.spread[1]), meeting);
        t.take(d, {zero, zero, one}, margin, hn::Set(d, motion.spread[2]), meeting);
        if (hn::AllFalse(d, meeting.possible(d)))
            continue;
        for (const auto& v : {t.a, t.b}) {
            const Lanes3<D> n = cross(sub(v[1], v[0]), sub(v[2], v[0]));
            const auto sum = hn::Add(hn::Abs(n.x), hn::Add(hn::Abs(n.y), hn::Abs(n.z)));
            const auto least = hn::Set(d, 0x1p-100F);
            t.take(d, n, hn::MulAdd(sum, margin, least),
                   hn::MulAdd(sum, hn::Set(d, motion.spread_any), least), meeting);
        }
        HWY_ALIGN float share[kPairs];
        hn::Store(meeting.share(d), d, share);
        for (std::size_t k = 0; k < hn::Lanes(d); ++k)
            result.share[(lane + k) / TriangleLeaf::kLanes][(lane + k) % TriangleLeaf::kLanes] =
                share[k];
        result.pairs |= bits_of(d, meeting.possible(d)) << lane;
    }
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(find_meeting_children);
HWY_EXPORT(find_meeting_triangles);

void find_meeting(const TimeSpan& span, const NodeChildren& a, const NodeChildren& b,
                  MeetingChildren& result) {
    HWY_DYNAMIC_DISPATCH(find_meeting_children)(span, a, b, result);
}
void find_meeting(const TimeSpan& span, const Node& node_a, const TriangleLeaf& a,
                  const Node& node_b, const TriangleLeaf& b, MeetingTriangles& result) {
    HWY_DYNAMIC_DISPATCH(find_meeting_triangles)(span, node_a, a, node_b, b, result);
}

} // namespace abut
#endif
