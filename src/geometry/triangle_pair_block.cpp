#include "geometry/triangle_pair_block.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/triangle_pair_block.cpp"
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
HWY_INLINE void distance_sq_with(D d, const TrianglePairBlock& pairs, double* result) {
    for (std::size_t lane = 0; lane < TrianglePairBlock::kLanes; lane += hn::Lanes(d))
        distance_sq_lanes(d, pairs, lane, result);
}

using PairLanes = hn::CappedTag<double, TrianglePairBlock::kLanes>;
using OneLane = hn::CappedTag<double, 1>;

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

HWY_EXPORT(distance_sq_simd);

void distance_sq(const TrianglePairBlock& pairs, double (&result)[TrianglePairBlock::kLanes]) {
    HWY_DYNAMIC_DISPATCH(distance_sq_simd)(pairs, result);
}
void distance_sq_reference(const TrianglePairBlock& pairs,
                           double (&result)[TrianglePairBlock::kLanes]) {
    HWY_STATIC_DISPATCH(distance_sq_one)(pairs, result);
}

} // namespace abut
#endif
