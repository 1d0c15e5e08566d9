#include "geometry/leaf/triangle_pair_batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/leaf/triangle_pair_batch.cpp"
#include "simd/foreach_target.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Squared distance of the segments p + s u and q + t v, s and t in [0, 1]. In: uu = u.u, vv = v.v.
template <class D>
HWY_INLINE hn::Vec<D> segment_segment_sq(D d, const Lanes3<D>& p, const Lanes3<D>& u, hn::Vec<D> uu,
                                         const Lanes3<D>& q, const Lanes3<D>& v, hn::Vec<D> vv) {
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
    const auto clamp = [&](auto x) HWY_ATTR { return hn::Min(hn::Max(x, zero), one); };
    // A zero-length segment has parameter 0: 0 / 1.
    const auto safe_uu = hn::IfThenElse(hn::Gt(uu, zero), uu, one);
    const auto safe_vv = hn::IfThenElse(hn::Gt(vv, zero), vv, one);
    const Lanes3<D> r = sub(q, p);
    const Lanes3<D> n = cross(u, v);
    const auto nn = dot(n, n);
    // First s for the two lines: s = (r x v) . n / n.n. Parallel lines take s = 0.
    const auto safe_nn = hn::IfThenElse(hn::Gt(nn, zero), nn, one);
    const auto s0 =
        hn::IfThenElseZero(hn::Gt(nn, zero), clamp(hn::Div(dot(cross(r, v), n), safe_nn)));
    // Then the best t for that s, and the best s for that t.
    const auto uv = dot(u, v);
    const auto t = clamp(hn::Div(hn::MulSub(s0, uv, dot(r, v)), safe_vv));
    const auto s = clamp(hn::Div(hn::MulAdd(t, uv, dot(r, u)), safe_uu));
    const Lanes3<D> gap = minus_scaled(minus_scaled(r, s, u), hn::Neg(t), v);
    return dot(gap, gap);
}

/// A face, given from the start of its longest edge u: there, a needle's foot is well determined
/// whatever its width.
template <class D>
struct Face {
    Lanes3<D> origin, u, v, n;
    hn::Vec<D> uu, nn;
};

/// In: vertices, edges from each to the next, and the edges' squared lengths.
template <class D>
HWY_INLINE Face<D> face(D d, const Lanes3<D> (&p)[3], const Lanes3<D> (&e)[3],
                        const hn::Vec<D> (&ee)[3]) {
    const auto is_1 = hn::And(hn::Gt(ee[1], ee[0]), hn::Ge(ee[1], ee[2]));
    const auto is_2 = hn::And(hn::Gt(ee[2], ee[0]), hn::Gt(ee[2], ee[1]));
    const auto pick = [&](auto x_0, auto x_1, auto x_2) HWY_ATTR {
        return hn::IfThenElse(is_1, x_1, hn::IfThenElse(is_2, x_2, x_0));
    };
    const auto pick_each =
        [&](const Lanes3<D>& x_0, const Lanes3<D>& x_1, const Lanes3<D>& x_2)
            HWY_ATTR { return if_then_else(is_1, x_1, if_then_else(is_2, x_2, x_0)); };
    Face<D> f;
    f.origin = pick_each(p[0], p[1], p[2]);
    f.u = pick_each(e[0], e[1], e[2]);
    const Lanes3<D> back = pick_each(e[2], e[0], e[1]);
    f.v = {hn::Neg(back.x), hn::Neg(back.y), hn::Neg(back.z)};
    f.n = cross(f.u, f.v);
    // A face that is a point has uu = 0 and nn = 0. The zero nn keeps its feet from counting.
    const auto uu = pick(ee[0], ee[1], ee[2]);
    f.uu = hn::IfThenElse(hn::Gt(uu, hn::Zero(d)), uu, hn::Set(d, 1.0));
    f.nn = dot(f.n, f.n);
    return f;
}

/// Squared distance of a point to a face if the foot lies within the face and is nearer than
/// `other`; otherwise `other`.
template <class D>
HWY_INLINE hn::Vec<D> vertex_face_sq(D d, const Lanes3<D>& p, const Face<D>& f, hn::Vec<D> other) {
    const auto zero = hn::Zero(d);
    const Lanes3<D> w = sub(p, f.origin);
    const auto safe_nn = hn::IfThenElse(hn::Gt(f.nn, zero), f.nn, hn::Set(d, 1.0));
    // h = (u x w) . n / n.n, and the best g for that h: g compensates for the error of h.
    const auto h = hn::Div(dot(cross(f.u, w), f.n), safe_nn);
    const Lanes3<D> rest = minus_scaled(w, h, f.v);
    const auto g = hn::Div(dot(rest, f.u), f.uu);
    const auto inside =
        hn::And(hn::And(hn::Ge(g, zero), hn::Ge(h, zero)),
                hn::And(hn::Le(hn::Add(g, h), hn::Set(d, 1.0)), hn::Gt(f.nn, zero)));
    const Lanes3<D> gap = minus_scaled(rest, g, f.u);
    return hn::IfThenElse(inside, hn::Min(other, dot(gap, gap)), other);
}

template <class D>
HWY_INLINE void distance_sq_lanes(D d, const TrianglePairBatch& pairs, std::size_t lane,
                                  double* result) {
    const Lanes3<D> a_v[3] = {load3(d, pairs.a[0], lane), load3(d, pairs.a[1], lane),
                              load3(d, pairs.a[2], lane)};
    const Lanes3<D> b_v[3] = {load3(d, pairs.b[0], lane), load3(d, pairs.b[1], lane),
                              load3(d, pairs.b[2], lane)};
    Lanes3<D> a_e[3], b_e[3];
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
HWY_INLINE void distance_sq_with(D d, const TrianglePairBatch& pairs, double* result) {
    for (std::size_t lane = 0; lane < TrianglePairBatch::kLanes; lane += hn::Lanes(d))
        distance_sq_lanes(d, pairs, lane, result);
}

using PairLanes = hn::CappedTag<double, TrianglePairBatch::kLanes>;
using OneLane = hn::CappedTag<double, 1>;

void distance_sq_simd(const TrianglePairBatch& pairs, double* result) {
    distance_sq_with(PairLanes(), pairs, result);
}
void distance_sq_one(const TrianglePairBatch& pairs, double* result) {
    distance_sq_with(OneLane(), pairs, result);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(distance_sq_simd);

void distance_sq(const TrianglePairBatch& pairs, double (&result)[TrianglePairBatch::kLanes]) {
    HWY_DYNAMIC_DISPATCH(distance_sq_simd)(pairs, result);
}
void distance_sq_reference(const TrianglePairBatch& pairs,
                           double (&result)[TrianglePairBatch::kLanes]) {
    HWY_STATIC_DISPATCH(distance_sq_one)(pairs, result);
}

} // namespace abut
#endif
