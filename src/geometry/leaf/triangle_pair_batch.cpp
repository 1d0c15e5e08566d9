#include "geometry/leaf/triangle_pair_batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/leaf/triangle_pair_batch.cpp"
#include "simd/foreach_target.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Keeps the least squared distance.
template <class D>
struct LeastSquare {
    hn::Vec<D> sq;

    HWY_INLINE explicit LeastSquare(D d) : sq(hn::Inf(d)) {}
    HWY_INLINE void take(hn::Vec<D> other_sq, const Lanes3<D>&, const Lanes3<D>&) {
        sq = hn::Min(sq, other_sq);
    }
};

/// Keeps the points with the least squared distance: the one on a, and the gap from it to the one on b.
template <class D>
struct NearestPoints {
    hn::Vec<D> sq;
    Lanes3<D> on_a, gap;

    HWY_INLINE explicit NearestPoints(D d)
        : sq(hn::Inf(d)), on_a{hn::Zero(d), hn::Zero(d), hn::Zero(d)}, gap(on_a) {}
    HWY_INLINE void take(hn::Vec<D> other_sq, const Lanes3<D>& other_on_a,
                         const Lanes3<D>& other_gap) {
        const auto nearer = hn::Lt(other_sq, sq);
        sq = hn::IfThenElse(nearer, other_sq, sq);
        on_a = if_then_else(nearer, other_on_a, on_a);
        gap = if_then_else(nearer, other_gap, gap);
    }
};

/// Takes the nearest points of the segments p + s u of a and q + t v of b, s and t in [0, 1]. In: uu
/// = u.u, vv = v.v.
template <class D, class Best>
HWY_INLINE void take_segments(D d, const Lanes3<D>& p, const Lanes3<D>& u, hn::Vec<D> uu,
                              const Lanes3<D>& q, const Lanes3<D>& v, hn::Vec<D> vv, Best& best) {
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
    best.take(dot(gap, gap), minus_scaled(p, hn::Neg(s), u), gap);
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

/// A point over a face: the gap from its foot to it, and the square of that. Infinite if the foot
/// lies outside the face.
template <class D>
struct Foot {
    hn::Vec<D> sq;
    Lanes3<D> gap;
};

template <class D>
HWY_INLINE Foot<D> foot(D d, const Lanes3<D>& p, const Face<D>& f) {
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
    return {hn::IfThenElse(inside, dot(gap, gap), hn::Inf(d)), gap};
}

/// The nearest features of the pairs from a lane on.
template <class Best, class D>
HWY_INLINE Best nearest(D d, const TrianglePairBatch& pairs, std::size_t lane) {
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
    Best best(d);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            take_segments(d, a_v[i], a_e[i], a_ee[i], b_v[j], b_e[j], b_ee[j], best);

    const Face<D> face_a = face(d, a_v, a_e, a_ee), face_b = face(d, b_v, b_e, b_ee);
    for (std::size_t i = 0; i < 3; ++i) {
        const Foot<D> on_a = foot(d, b_v[i], face_a), on_b = foot(d, a_v[i], face_b);
        best.take(on_a.sq, sub(b_v[i], on_a.gap), on_a.gap);
        best.take(on_b.sq, a_v[i], {hn::Neg(on_b.gap.x), hn::Neg(on_b.gap.y), hn::Neg(on_b.gap.z)});
    }
    return best;
}

template <class D>
HWY_INLINE void distance_sq_with(D d, const TrianglePairBatch& pairs, double* result) {
    for (std::size_t lane = 0; lane < TrianglePairBatch::kLanes; lane += hn::Lanes(d))
        hn::StoreU(nearest<LeastSquare<D>>(d, pairs, lane).sq, d, result + lane);
}

template <class D>
HWY_INLINE void nearest_points_with(D d, const TrianglePairBatch& pairs, PairPoints& result) {
    for (std::size_t lane = 0; lane < TrianglePairBatch::kLanes; lane += hn::Lanes(d)) {
        const auto best = nearest<NearestPoints<D>>(d, pairs, lane);
        hn::StoreU(best.sq, d, result.distance_sq + lane);
        hn::StoreU(best.on_a.x, d, result.on_a[0] + lane);
        hn::StoreU(best.on_a.y, d, result.on_a[1] + lane);
        hn::StoreU(best.on_a.z, d, result.on_a[2] + lane);
        hn::StoreU(best.gap.x, d, result.gap[0] + lane);
        hn::StoreU(best.gap.y, d, result.gap[1] + lane);
        hn::StoreU(best.gap.z, d, result.gap[2] + lane);
    }
}

using PairLanes = hn::CappedTag<double, TrianglePairBatch::kLanes>;
using OneLane = hn::CappedTag<double, 1>;

void distance_sq_simd(const TrianglePairBatch& pairs, double* result) {
    distance_sq_with(PairLanes(), pairs, result);
}
void distance_sq_one(const TrianglePairBatch& pairs, double* result) {
    distance_sq_with(OneLane(), pairs, result);
}
void nearest_points_simd(const TrianglePairBatch& pairs, PairPoints& result) {
    nearest_points_with(PairLanes(), pairs, result);
}
void nearest_points_one(const TrianglePairBatch& pairs, PairPoints& result) {
    nearest_points_with(OneLane(), pairs, result);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(distance_sq_simd);
HWY_EXPORT(nearest_points_simd);

void distance_sq(const TrianglePairBatch& pairs, double (&result)[TrianglePairBatch::kLanes]) {
    HWY_DYNAMIC_DISPATCH(distance_sq_simd)(pairs, result);
}
void distance_sq_reference(const TrianglePairBatch& pairs,
                           double (&result)[TrianglePairBatch::kLanes]) {
    HWY_STATIC_DISPATCH(distance_sq_one)(pairs, result);
}

void nearest_points(const TrianglePairBatch& pairs, PairPoints& result) {
    HWY_DYNAMIC_DISPATCH(nearest_points_simd)(pairs, result);
}
void nearest_points_reference(const TrianglePairBatch& pairs, PairPoints& result) {
    HWY_STATIC_DISPATCH(nearest_points_one)(pairs, result);
}

} // namespace abut
#endif
