// Two triangles in each lane: sides of planes, intervals on the planes' common line, gaps of boxes.
// Every answer is certain, or left open.

// Included once for each target.
#if defined(ABUT_GEOMETRY_LEAF_TRIANGLE_PAIR_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_GEOMETRY_LEAF_TRIANGLE_PAIR_LANES_INL_H
#undef ABUT_GEOMETRY_LEAF_TRIANGLE_PAIR_LANES_INL_H
#else
#define ABUT_GEOMETRY_LEAF_TRIANGLE_PAIR_LANES_INL_H
#endif

#include "geometry/leaf/triangle_leaf.h"
#include "math/lanes-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Error bound of a determinant of three edges.
///
/// With edges below U and W whose coordinates are off by e, a determinant of two U and one W has 6
/// products. It is off by 6 ((U + e)^2 (W + e) - U^2 W), and by 32 eps U^2 W from rounding. The
/// last term covers underflow. Near overflow, nothing is certain.
template <class D>
HWY_INLINE hn::Vec<D> determinant_bound(D d, hn::Vec<D> u, hn::Vec<D> w, hn::Vec<D> e) {
    const auto uuw = hn::Mul(hn::Mul(u, u), w);
    const auto two = hn::Set(d, 2.0F);
    // e (2 U W + U^2 + e (2 U + W + e))
    const auto inner = hn::MulAdd(two, u, hn::Add(w, e));
    const auto outer = hn::MulAdd(e, inner, hn::Mul(u, hn::MulAdd(two, w, u)));
    auto bound =
        hn::MulAdd(hn::Set(d, 6.1F), hn::Mul(e, outer), hn::Mul(hn::Set(d, 40 * 0x1p-24F), uuw));
    bound = hn::Add(bound, hn::Mul(hn::Set(d, 0x1p-110F), hn::Add(w, hn::Set(d, 1.0F))));
    return hn::IfThenElse(hn::Lt(uuw, hn::Set(d, 0x1p110F)), bound,
                          hn::Set(d, std::numeric_limits<float>::infinity()));
}

/// Three vertices q against a plane through p: the values n . (q - p), and a bound on their errors.
template <class D>
struct Sides {
    hn::Vec<D> s[3], bound;

    /// How far all three certainly are on one side, times |n|; 0 or less if that is not certain.
    HWY_INLINE hn::Vec<D> certain() const {
        return hn::Sub(hn::Max(min3(s[0], s[1], s[2]), hn::Neg(max3(s[0], s[1], s[2]))), bound);
    }
};

/// A triangle's plane, and a bound on its edges' coordinates.
template <class D>
struct Plane {
    Lanes3<D> origin, n;
    hn::Vec<D> edge;

    HWY_INLINE Plane(const Lanes3<D> (&t)[3]) : origin(t[0]) {
        const Lanes3<D> u = sub(t[1], t[0]), v = sub(t[2], t[0]);
        n = cross(u, v);
        edge = hn::Max(max_abs(u), max_abs(v));
    }
    HWY_INLINE Sides<D> sides(D d, const Lanes3<D> (&q)[3], hn::Vec<D> e) const {
        const Lanes3<D> w0 = sub(q[0], origin), w1 = sub(q[1], origin), w2 = sub(q[2], origin);
        const auto reach = max3(max_abs(w0), max_abs(w1), max_abs(w2));
        return {{dot(n, w0), dot(n, w1), dot(n, w2)}, determinant_bound(d, edge, reach, e)};
    }
    /// Upper bound on the squared length of the exact normal: (|n| + |dn|)^2 <= 1.004 n.n + 257
    /// dn.dn, where each coordinate of dn is below 2 e (2 U + e) + 8 eps U^2.
    HWY_INLINE hn::Vec<D> most_nn(D d, hn::Vec<D> e) const {
        const auto two = hn::Set(d, 2.0F);
        const auto dn = hn::MulAdd(hn::Mul(two, e), hn::MulAdd(two, edge, e),
                                   hn::Mul(hn::Set(d, 8 * 0x1p-24F), hn::Mul(edge, edge)));
        return hn::MulAdd(
            hn::Set(d, 1.004F), dot(n, n),
            hn::MulAdd(hn::Set(d, 3 * 257.0F), hn::Mul(dn, dn), hn::Set(d, 0x1p-100F)));
    }
};

/// A triangle whose vertices certainly lie off a plane, on both sides of it. The apex is the vertex
/// that is alone on its side. In lanes where a side is not certain, the members must not be used.
template <class D>
struct LaneCut {
    Lanes3<D> apex, first, last; ///< the edges' other ends, in the order in which the planes'
                                 ///< common line meets the edges
    hn::Mask<D> apex_over, certain;
};

/// Finds the apex. `forward`: whether the edge to the next vertex comes last if the apex is above
/// the plane, as for the first triangle (see triangle_triangle_intersect).
template <class D>
HWY_INLINE LaneCut<D> cut(D d, const Lanes3<D> (&t)[3], const Sides<D>& side, bool forward) {
    const auto zero = hn::Zero(d);
    const auto over0 = hn::Gt(side.s[0], zero), over1 = hn::Gt(side.s[1], zero),
               over2 = hn::Gt(side.s[2], zero);
    const auto alone1 = hn::AndNot(hn::Xor(over0, over2), hn::Xor(over0, over1));
    const auto alone2 = hn::AndNot(hn::Xor(over0, over1), hn::Xor(over0, over2));
    const auto pick = [&](const Lanes3<D>& x0, const Lanes3<D>& x1, const Lanes3<D>& x2) HWY_ATTR {
        return if_then_else(alone1, x1, if_then_else(alone2, x2, x0));
    };
    LaneCut<D> c;
    c.apex = pick(t[0], t[1], t[2]);
    const Lanes3<D> left = pick(t[1], t[2], t[0]), right = pick(t[2], t[0], t[1]);
    c.apex_over = hn::Or(hn::And(alone1, over1),
                         hn::Or(hn::And(alone2, over2), hn::AndNot(hn::Or(alone1, alone2), over0)));
    const auto left_last = forward ? c.apex_over : hn::Not(c.apex_over);
    c.first = if_then_else(left_last, right, left);
    c.last = if_then_else(left_last, left, right);
    c.certain =
        hn::Gt(min3(hn::Abs(side.s[0]), hn::Abs(side.s[1]), hn::Abs(side.s[2])), side.bound);
    return c;
}

/// Compares the two triangles' intervals on their planes' common line, in lanes where each triangle
/// straddles the other's plane. The two signs are those of triangle_triangle_intersect, with an
/// error bound.
template <class D>
struct Intervals {
    hn::Mask<D> overlap, miss; ///< both certain
};

template <class D>
HWY_INLINE Intervals<D> compare_intervals(D d, const LaneCut<D>& a, const LaneCut<D>& b,
                                          hn::Vec<D> e) {
    const auto same = hn::Not(hn::Xor(a.apex_over, b.apex_over));
    const auto order = [&](const Lanes3<D>& end_a, const Lanes3<D>& end_b,
                           hn::Vec<D>& bound) HWY_ATTR {
        const Lanes3<D> u = sub(end_a, a.apex), v = sub(b.apex, a.apex), w = sub(end_b, a.apex);
        bound = determinant_bound(d, hn::Max(max_abs(u), max_abs(v)), max_abs(w), e);
        const auto det = dot(cross(u, v), w);
        return hn::IfThenElse(same, det, hn::Neg(det));
    };
    hn::Vec<D> bound_1, bound_2;
    const auto a_before_b = order(a.last, b.first, bound_1);
    const auto a_to_b = order(a.first, b.last, bound_2);
    const auto certain = hn::And(a.certain, b.certain);
    return {
        hn::And(certain, hn::And(hn::Lt(a_before_b, hn::Neg(bound_1)), hn::Gt(a_to_b, bound_2))),
        hn::And(certain, hn::Or(hn::Gt(a_before_b, bound_1), hn::Lt(a_to_b, hn::Neg(bound_2))))};
}

/// The gaps between the boxes of pairs of triangles along the axes, which certainly exist: those
/// that exceed the margin, less the margin.
template <class D>
HWY_INLINE Lanes3<D> box_gaps(D d, const Lanes3<D>* a, const Lanes3<D>* b, hn::Vec<D> margin) {
    const auto zero = hn::Zero(d);
    const auto gap = [&](auto p0, auto p1, auto p2, auto q0, auto q1, auto q2) HWY_ATTR {
        const auto apart = hn::Max(hn::Sub(min3(p0, p1, p2), max3(q0, q1, q2)),
                                   hn::Sub(min3(q0, q1, q2), max3(p0, p1, p2)));
        return hn::Max(zero, hn::Sub(apart, margin));
    };
    return {gap(a[0].x, a[1].x, a[2].x, b[0].x, b[1].x, b[2].x),
            gap(a[0].y, a[1].y, a[2].y, b[0].y, b[1].y, b[2].y),
            gap(a[0].z, a[1].z, a[2].z, b[0].z, b[1].z, b[2].z)};
}

/// The pairs in the lanes, sorted by what is certain of them. The sets have no common lane.
template <class D>
struct DecidedPairs {
    hn::Mask<D> cross, may_meet, may_be_near; ///< see LeafPairs
};

/// Decides pairs of triangles in one frame. `bound` is used only with `with_near`.
template <bool with_near, class D>
HWY_INLINE DecidedPairs<D> decide_pairs(D d, const Lanes3<D> (&a)[3], const Lanes3<D> (&b)[3],
                                        hn::Vec<D> margin, const LeafBound& bound) {
    const auto zero = hn::Zero(d), e = hn::Add(margin, margin);
    const auto none = hn::MaskFromVec(zero);
    const Lanes3<D> g = box_gaps(d, a, b, margin);
    auto meet = hn::Le(max3(g.x, g.y, g.z), zero);
    auto near = meet;
    if constexpr (with_near) {
        // The rounding of squares, sums and products is below this factor in total.
        const auto bound_sq = hn::Set(d, bound.bound_sq * (1 + 0x1p-18F));
        near = hn::Not(hn::Gt(dot(g, g), bound_sq));
        const Lanes3<D> n = set3(d, bound.direction);
        const auto along = hn::Sub(min3(dot(n, b[0]), dot(n, b[1]), dot(n, b[2])),
                                   max3(dot(n, a[0]), dot(n, a[1]), dot(n, a[2])));
        const auto sizes = hn::Add(hn::Abs(n.x), hn::Add(hn::Abs(n.y), hn::Abs(n.z)));
        const auto certain = hn::Max(zero, hn::NegMulAdd(sizes, hn::Add(e, margin), along));
        near = hn::AndNot(
            hn::Gt(hn::Mul(certain, certain), hn::Set(d, bound.along_sq * (1 + 0x1p-18F))), near);
        if (hn::AllFalse(d, near))
            return {none, none, none};
    } else if (hn::AllFalse(d, meet)) {
        return {none, none, none};
    }
    const Plane<D> plane_a(a), plane_b(b);
    const Sides<D> b_sides = plane_a.sides(d, b, e), a_sides = plane_b.sides(d, a, e);
    const auto b_certain = b_sides.certain(), a_certain = a_sides.certain();
    meet = hn::AndNot(hn::Or(hn::Gt(b_certain, zero), hn::Gt(a_certain, zero)), meet);
    if constexpr (with_near) {
        // side / |n| is the distance to a plane.
        const auto bound_sq = hn::Set(d, bound.bound_sq * (1 + 0x1p-16F));
        const auto far = [&](auto side, auto nn) HWY_ATTR {
            side = hn::Max(zero, side);
            return hn::Gt(hn::Mul(side, side), hn::Mul(bound_sq, nn));
        };
        near = hn::AndNot(
            hn::Or(far(b_certain, plane_a.most_nn(d, e)), far(a_certain, plane_b.most_nn(d, e))),
            near);
    }
    auto cross = none;
    if (!hn::AllFalse(d, meet)) {
        const Intervals<D> intervals =
            compare_intervals(d, cut(d, a, a_sides, true), cut(d, b, b_sides, false), e);
        cross = hn::And(meet, intervals.overlap);
        meet = hn::AndNot(hn::Or(intervals.overlap, intervals.miss), meet);
    }
    return {cross, meet, with_near ? hn::AndNot(hn::Or(cross, meet), near) : none};
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
