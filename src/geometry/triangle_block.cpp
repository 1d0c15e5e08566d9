#include "geometry/triangle_block.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/triangle_block.cpp"
#include "simd/foreach_target.h"
#include "simd/simd.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Three lanes-wide coordinates.
template <class D>
struct Vec {
    using V = hn::Vec<D>;
    V x, y, z;
};

template <class D>
HWY_INLINE Vec<D> sub(const Vec<D>& a, const Vec<D>& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class D>
HWY_INLINE hn::Vec<D> dot(const Vec<D>& a, const Vec<D>& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class D>
HWY_INLINE Vec<D> cross(const Vec<D>& a, const Vec<D>& b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
/// a - s b
template <class D>
HWY_INLINE Vec<D> minus_scaled(const Vec<D>& a, hn::Vec<D> s, const Vec<D>& b) {
    return {hn::NegMulAdd(s, b.x, a.x), hn::NegMulAdd(s, b.y, a.y), hn::NegMulAdd(s, b.z, a.z)};
}
template <class D>
HWY_INLINE Vec<D> broadcast(D d, const Vec3& p) {
    return {hn::Set(d, p.x), hn::Set(d, p.y), hn::Set(d, p.z)};
}
template <class D, std::size_t n>
HWY_INLINE Vec<D> load(D d, const double (&v)[3][n], std::size_t lane) {
    return {hn::Load(d, &v[0][lane]), hn::Load(d, &v[1][lane]), hn::Load(d, &v[2][lane])};
}
template <class D>
HWY_INLINE hn::Vec<D> max_abs(const Vec<D>& a) {
    return hn::Max(hn::Abs(a.x), hn::Max(hn::Abs(a.y), hn::Abs(a.z)));
}
template <class V>
HWY_INLINE V min3(V a, V b, V c) {
    return hn::Min(a, hn::Min(b, c));
}
template <class V>
HWY_INLINE V max3(V a, V b, V c) {
    return hn::Max(a, hn::Max(b, c));
}

/// Three vertices against a plane: n . (q - p), and what each may be off by.
///
/// |computed - true| is below 32 eps e^2 d for edges below e and differences below d: 3 products of
/// 3 factors each, at most 9 roundings on any path. The smallest normal number covers underflow.
template <class D>
struct Sides {
    hn::Vec<D> s[3], bound;

    /// How far all three certainly are on one side, times |n|; 0 or less if that is not certain.
    HWY_INLINE hn::Vec<D> certain() const {
        return hn::Sub(hn::Max(min3(s[0], s[1], s[2]), hn::Neg(max3(s[0], s[1], s[2]))), bound);
    }
};

template <class D>
HWY_INLINE hn::Vec<D> rounding_bound(D d, hn::Vec<D> edge, hn::Vec<D> reach) {
    return hn::MulAdd(hn::Mul(hn::Set(d, 32 * 0x1p-53), hn::Mul(edge, edge)), reach,
                      hn::Mul(hn::Set(d, 0x1p-1000), hn::Add(reach, hn::Set(d, 1.0))));
}

template <class D>
HWY_INLINE Sides<D> sides(D d, const Vec<D>& n, const Vec<D>& u, const Vec<D>& v, const Vec<D>& p,
                          const Vec<D> (&q)[3]) {
    const Vec<D> w0 = sub<D>(q[0], p), w1 = sub<D>(q[1], p), w2 = sub<D>(q[2], p);
    return {{dot<D>(n, w0), dot<D>(n, w1), dot<D>(n, w2)},
            rounding_bound(d, hn::Max(max_abs<D>(u), max_abs<D>(v)),
                           max3(max_abs<D>(w0), max_abs<D>(w1), max_abs<D>(w2)))};
}

/// What tells a triangle from four others cheaply.
template <class D>
struct Apart {
    Vec<D> a[3], b[3];         ///< the triangles
    hn::Vec<D> box_sq;         ///< squared gap of the boxes; 0 if they overlap
    Sides<D> b_sides, a_sides; ///< of b's vertices against a's plane; of a's against b's
    hn::Vec<D> nn_a, nn_b;     ///< squared normals
};

template <class D>
HWY_INLINE Apart<D> compare(D d, const Triangle& ta, const TriangleBlock& tb, std::size_t lane) {
    Apart<D> x;
    for (std::size_t i = 0; i < 3; ++i) {
        x.a[i] = broadcast(d, ta[i]);
        x.b[i] = load(d, tb.v[i], lane);
    }
    const auto gap = [&](auto p0, auto p1, auto p2, auto q0, auto q1, auto q2) HWY_ATTR {
        return hn::Max(hn::Zero(d), hn::Max(hn::Sub(min3(p0, p1, p2), max3(q0, q1, q2)),
                                            hn::Sub(min3(q0, q1, q2), max3(p0, p1, p2))));
    };
    const Vec<D> g{gap(x.a[0].x, x.a[1].x, x.a[2].x, x.b[0].x, x.b[1].x, x.b[2].x),
                   gap(x.a[0].y, x.a[1].y, x.a[2].y, x.b[0].y, x.b[1].y, x.b[2].y),
                   gap(x.a[0].z, x.a[1].z, x.a[2].z, x.b[0].z, x.b[1].z, x.b[2].z)};
    x.box_sq = dot<D>(g, g);
    const Vec<D> ua = sub<D>(x.a[1], x.a[0]), va = sub<D>(x.a[2], x.a[0]);
    const Vec<D> ub = sub<D>(x.b[1], x.b[0]), vb = sub<D>(x.b[2], x.b[0]);
    const Vec<D> na = cross<D>(ua, va), nb = cross<D>(ub, vb);
    x.b_sides = sides(d, na, ua, va, x.a[0], x.b);
    x.a_sides = sides(d, nb, ub, vb, x.b[0], x.a);
    x.nn_a = dot<D>(na, na);
    x.nn_b = dot<D>(nb, nb);
    return x;
}

/// A triangle whose vertices lie certainly off a plane, on both sides of it: its apex lies alone on
/// one. In lanes where a side is not certain, no vertex is taken for anything.
template <class D>
struct LaneCut {
    Vec<D> apex, first, last; ///< the edges from the apex, as the line of both planes meets them
    hn::Mask<D> apex_over, certain;
};

/// `forward`: whether the edge to the next vertex comes last if the apex is over the plane, as for
/// the first triangle (see triangle_triangle_intersect).
template <class D>
HWY_INLINE LaneCut<D> cut(D d, const Vec<D> (&t)[3], const Sides<D>& side, bool forward) {
    const auto zero = hn::Zero(d);
    const auto over0 = hn::Gt(side.s[0], zero), over1 = hn::Gt(side.s[1], zero),
               over2 = hn::Gt(side.s[2], zero);
    const auto alone1 = hn::AndNot(hn::Xor(over0, over2), hn::Xor(over0, over1));
    const auto alone2 = hn::AndNot(hn::Xor(over0, over1), hn::Xor(over0, over2));
    const auto pick = [&](const Vec<D>& x_0, const Vec<D>& x_1, const Vec<D>& x_2) HWY_ATTR {
        const auto each = [&](auto x0, auto x1, auto x2) HWY_ATTR {
            return hn::IfThenElse(alone1, x1, hn::IfThenElse(alone2, x2, x0));
        };
        return Vec<D>{each(x_0.x, x_1.x, x_2.x), each(x_0.y, x_1.y, x_2.y),
                      each(x_0.z, x_1.z, x_2.z)};
    };
    const auto choose = [&](hn::Mask<D> m, const Vec<D>& yes, const Vec<D>& no) HWY_ATTR {
        return Vec<D>{hn::IfThenElse(m, yes.x, no.x), hn::IfThenElse(m, yes.y, no.y),
                      hn::IfThenElse(m, yes.z, no.z)};
    };
    LaneCut<D> c;
    c.apex = pick(t[0], t[1], t[2]);
    const Vec<D> left = pick(t[1], t[2], t[0]), right = pick(t[2], t[0], t[1]);
    c.apex_over = hn::Or(hn::And(alone1, over1),
                         hn::Or(hn::And(alone2, over2), hn::AndNot(hn::Or(alone1, alone2), over0)));
    const auto left_last = forward ? c.apex_over : hn::Not(c.apex_over);
    c.first = choose(left_last, right, left);
    c.last = choose(left_last, left, right);
    c.certain =
        hn::Gt(min3(hn::Abs(side.s[0]), hn::Abs(side.s[1]), hn::Abs(side.s[2])), side.bound);
    return c;
}

/// Lanes where each triangle straddles the other's plane, but their intervals on the common line
/// certainly miss each other: the two signs of triangle_triangle_intersect, with a bound.
template <class D>
HWY_INLINE hn::Mask<D> certainly_missing(D d, const Apart<D>& x) {
    const LaneCut<D> a = cut(d, x.a, x.a_sides, true), b = cut(d, x.b, x.b_sides, false);
    const auto same = hn::Not(hn::Xor(a.apex_over, b.apex_over));
    const auto order = [&](const Vec<D>& end_a, const Vec<D>& end_b, hn::Vec<D>& bound) HWY_ATTR {
        const Vec<D> u = sub<D>(end_a, a.apex), v = sub<D>(b.apex, a.apex),
                     w = sub<D>(end_b, a.apex);
        bound = rounding_bound(d, hn::Max(max_abs<D>(u), max_abs<D>(v)), max_abs<D>(w));
        const auto det = dot<D>(cross<D>(u, v), w);
        return hn::IfThenElse(same, det, hn::Neg(det));
    };
    hn::Vec<D> bound_1, bound_2;
    const auto a_before_b = order(a.last, b.first, bound_1);
    const auto a_to_b = order(a.first, b.last, bound_2);
    return hn::And(hn::And(a.certain, b.certain),
                   hn::Or(hn::Gt(a_before_b, bound_1), hn::Lt(a_to_b, hn::Neg(bound_2))));
}

template <class D>
HWY_INLINE std::uint32_t bits_of(D d, hn::Mask<D> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return static_cast<std::uint32_t>(bits[0]) & ((1U << hn::MaxLanes(d)) - 1);
}

template <class D>
HWY_INLINE hn::Mask<D> certainly_apart(D d, const Apart<D>& x) {
    // A gap so small that its square vanishes is left to the exact test.
    const auto zero = hn::Zero(d);
    const auto apart = hn::Or(hn::Gt(x.box_sq, zero), hn::Or(hn::Gt(x.b_sides.certain(), zero),
                                                             hn::Gt(x.a_sides.certain(), zero)));
    return hn::AllTrue(d, apart) ? apart : hn::Or(apart, certainly_missing(d, x));
}

/// Lanes farther apart than the bound: side / |n| is a distance to a plane.
template <class D>
HWY_INLINE hn::Mask<D> certainly_far(D d, const Apart<D>& x, hn::Vec<D> bound_sq) {
    const auto zero = hn::Zero(d);
    const auto a = hn::Max(zero, x.b_sides.certain()), b = hn::Max(zero, x.a_sides.certain());
    // Squares and the squared normals are rounded: by less than this together.
    const auto bound = hn::Mul(bound_sq, hn::Set(d, 1 + 0x1p-40));
    return hn::Or(hn::Gt(x.box_sq, bound), hn::Or(hn::Gt(hn::Mul(a, a), hn::Mul(bound, x.nn_a)),
                                                  hn::Gt(hn::Mul(b, b), hn::Mul(bound, x.nn_b))));
}

/// Squared distance of the segments p + s u and q + t v, s and t in [0, 1]; uu = u.u, vv = v.v.
template <class D>
HWY_INLINE hn::Vec<D> segment_segment_sq(D d, const Vec<D>& p, const Vec<D>& u, hn::Vec<D> uu,
                                         const Vec<D>& q, const Vec<D>& v, hn::Vec<D> vv) {
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
    const auto clamp = [&](auto x) HWY_ATTR { return hn::Min(hn::Max(x, zero), one); };
    // A zero-length segment has parameter 0: 0 / 1.
    const auto safe_uu = hn::IfThenElse(hn::Gt(uu, zero), uu, one);
    const auto safe_vv = hn::IfThenElse(hn::Gt(vv, zero), vv, one);
    const Vec<D> r = sub(q, p);
    const Vec<D> n = cross(u, v);
    const auto nn = dot(n, n);
    // Lines: s = (r x v) . n / n.n; parallel ones take s = 0.
    const auto safe_nn = hn::IfThenElse(hn::Gt(nn, zero), nn, one);
    const auto s0 =
        hn::IfThenElseZero(hn::Gt(nn, zero), clamp(hn::Div(dot(cross(r, v), n), safe_nn)));
    // Then the best t for that s, and the best s for that t.
    const auto uv = dot(u, v);
    const auto t = clamp(hn::Div(hn::MulSub(s0, uv, dot(r, v)), safe_vv));
    const auto s = clamp(hn::Div(hn::MulAdd(t, uv, dot(r, u)), safe_uu));
    const Vec<D> gap = minus_scaled(minus_scaled(r, s, u), hn::Neg(t), v);
    return dot(gap, gap);
}

/// A face from the start of its longest edge u: there, a needle's foot is well determined whatever
/// its width.
template <class D>
struct Face {
    Vec<D> origin, u, v, n;
    hn::Vec<D> uu, nn;
};

/// In: vertices, edges from each to the next, and the edges' squared lengths.
template <class D>
HWY_INLINE Face<D> face(D d, const Vec<D> (&p)[3], const Vec<D> (&e)[3],
                        const hn::Vec<D> (&ee)[3]) {
    const auto is_1 = hn::And(hn::Gt(ee[1], ee[0]), hn::Ge(ee[1], ee[2]));
    const auto is_2 = hn::And(hn::Gt(ee[2], ee[0]), hn::Gt(ee[2], ee[1]));
    const auto pick = [&](auto x_0, auto x_1, auto x_2) HWY_ATTR {
        return hn::IfThenElse(is_1, x_1, hn::IfThenElse(is_2, x_2, x_0));
    };
    const auto pick_each = [&](const Vec<D>& x_0, const Vec<D>& x_1, const Vec<D>& x_2) HWY_ATTR {
        return Vec<D>{pick(x_0.x, x_1.x, x_2.x), pick(x_0.y, x_1.y, x_2.y),
                      pick(x_0.z, x_1.z, x_2.z)};
    };
    Face<D> f;
    f.origin = pick_each(p[0], p[1], p[2]);
    f.u = pick_each(e[0], e[1], e[2]);
    const Vec<D> back = pick_each(e[2], e[0], e[1]);
    f.v = {hn::Neg(back.x), hn::Neg(back.y), hn::Neg(back.z)};
    f.n = cross<D>(f.u, f.v);
    // A face that is a point has uu = 0 and nn = 0, which keeps its feet from counting.
    const auto uu = pick(ee[0], ee[1], ee[2]);
    f.uu = hn::IfThenElse(hn::Gt(uu, hn::Zero(d)), uu, hn::Set(d, 1.0));
    f.nn = dot<D>(f.n, f.n);
    return f;
}

/// Squared distance of a point to a face if the foot lies within; else `other`, the edges being
/// nearer.
template <class D>
HWY_INLINE hn::Vec<D> vertex_face_sq(D d, const Vec<D>& p, const Face<D>& f, hn::Vec<D> other) {
    const auto zero = hn::Zero(d);
    const Vec<D> w = sub<D>(p, f.origin);
    const auto safe_nn = hn::IfThenElse(hn::Gt(f.nn, zero), f.nn, hn::Set(d, 1.0));
    // h = (u x w) . n / n.n, and the best g for that h: what h is off by, g makes up for.
    const auto h = hn::Div(dot<D>(cross<D>(f.u, w), f.n), safe_nn);
    const Vec<D> rest = minus_scaled<D>(w, h, f.v);
    const auto g = hn::Div(dot<D>(rest, f.u), f.uu);
    const auto inside =
        hn::And(hn::And(hn::Ge(g, zero), hn::Ge(h, zero)),
                hn::And(hn::Le(hn::Add(g, h), hn::Set(d, 1.0)), hn::Gt(f.nn, zero)));
    const Vec<D> gap = minus_scaled<D>(rest, g, f.u);
    return hn::IfThenElse(inside, hn::Min(other, dot<D>(gap, gap)), other);
}

template <class D>
HWY_INLINE void distance_sq_lanes(D d, const TrianglePairBlock& pairs, std::size_t lane,
                                  double* result) {
    const Vec<D> a_v[3] = {load(d, pairs.a[0], lane), load(d, pairs.a[1], lane),
                           load(d, pairs.a[2], lane)};
    const Vec<D> b_v[3] = {load(d, pairs.b[0], lane), load(d, pairs.b[1], lane),
                           load(d, pairs.b[2], lane)};
    Vec<D> a_e[3], b_e[3];
    hn::Vec<D> a_ee[3], b_ee[3];
    for (std::size_t i = 0; i < 3; ++i) {
        a_e[i] = sub(a_v[(i + 1) % 3], a_v[i]);
        b_e[i] = sub(b_v[(i + 1) % 3], b_v[i]);
        a_ee[i] = dot(a_e[i], a_e[i]);
        b_ee[i] = dot(b_e[i], b_e[i]);
    }
    auto best = segment_segment_sq(d, a_v[0], a_e[0], a_ee[0], b_v[0], b_e[0], b_ee[0]);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i == 0 ? 1 : 0; j < 3; ++j)
            best = hn::Min(best,
                           segment_segment_sq(d, a_v[i], a_e[i], a_ee[i], b_v[j], b_e[j], b_ee[j]));

    const Face<D> face_a = face(d, a_v, a_e, a_ee), face_b = face(d, b_v, b_e, b_ee);
    for (std::size_t i = 0; i < 3; ++i) {
        best = vertex_face_sq(d, b_v[i], face_a, best);
        best = vertex_face_sq(d, a_v[i], face_b, best);
    }
    hn::StoreU(best, d, result + lane);
}

template <class D>
HWY_INLINE std::uint32_t may_intersect_with(D d, const Triangle& a, const TriangleBlock& b) {
    std::uint32_t lanes = 0;
    for (std::size_t lane = 0; lane < TriangleBlock::kLanes; lane += hn::Lanes(d))
        lanes |= bits_of(d, hn::Not(certainly_apart(d, compare(d, a, b, lane)))) << lane;
    return lanes;
}
template <class D>
HWY_INLINE NearLanes near_lanes_with(D d, const Triangle& a, const TriangleBlock& b,
                                     double bound_sq) {
    NearLanes lanes{0, 0};
    for (std::size_t lane = 0; lane < TriangleBlock::kLanes; lane += hn::Lanes(d)) {
        const Apart<D> x = compare(d, a, b, lane);
        lanes.may_intersect |= bits_of(d, hn::Not(certainly_apart(d, x))) << lane;
        lanes.may_be_near |= bits_of(d, hn::Not(certainly_far(d, x, hn::Set(d, bound_sq)))) << lane;
    }
    return lanes;
}
template <class D>
HWY_INLINE void distance_sq_with(D d, const TrianglePairBlock& pairs, double* result) {
    for (std::size_t lane = 0; lane < TrianglePairBlock::kLanes; lane += hn::Lanes(d))
        distance_sq_lanes(d, pairs, lane, result);
}

using BlockLanes = hn::CappedTag<double, TriangleBlock::kLanes>;
using PairLanes = hn::CappedTag<double, TrianglePairBlock::kLanes>;
using OneLane = hn::CappedTag<double, 1>;

std::uint32_t may_intersect_simd(const Triangle& a, const TriangleBlock& b) {
    return may_intersect_with(BlockLanes(), a, b);
}
std::uint32_t may_intersect_one(const Triangle& a, const TriangleBlock& b) {
    return may_intersect_with(OneLane(), a, b);
}
NearLanes near_lanes_simd(const Triangle& a, const TriangleBlock& b, double bound_sq) {
    return near_lanes_with(BlockLanes(), a, b, bound_sq);
}
NearLanes near_lanes_one(const Triangle& a, const TriangleBlock& b, double bound_sq) {
    return near_lanes_with(OneLane(), a, b, bound_sq);
}
void distance_sq_simd(const TrianglePairBlock& pairs, double* result) {
    distance_sq_with(PairLanes(), pairs, result);
}
void distance_sq_one(const TrianglePairBlock& pairs, double* result) {
    distance_sq_with(OneLane(), pairs, result);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(may_intersect_simd);
HWY_EXPORT(near_lanes_simd);
HWY_EXPORT(distance_sq_simd);

std::uint32_t may_intersect(const Triangle& a, const TriangleBlock& b) {
    return HWY_DYNAMIC_DISPATCH(may_intersect_simd)(a, b);
}
std::uint32_t may_intersect_reference(const Triangle& a, const TriangleBlock& b) {
    return HWY_STATIC_DISPATCH(may_intersect_one)(a, b);
}
NearLanes near_lanes(const Triangle& a, const TriangleBlock& b, double bound_sq) {
    return HWY_DYNAMIC_DISPATCH(near_lanes_simd)(a, b, bound_sq);
}
NearLanes near_lanes_reference(const Triangle& a, const TriangleBlock& b, double bound_sq) {
    return HWY_STATIC_DISPATCH(near_lanes_one)(a, b, bound_sq);
}
void distance_sq(const TrianglePairBlock& pairs, double (&result)[TrianglePairBlock::kLanes]) {
    HWY_DYNAMIC_DISPATCH(distance_sq_simd)(pairs, result);
}
void distance_sq_reference(const TrianglePairBlock& pairs,
                           double (&result)[TrianglePairBlock::kLanes]) {
    HWY_STATIC_DISPATCH(distance_sq_one)(pairs, result);
}

} // namespace abut
#endif
