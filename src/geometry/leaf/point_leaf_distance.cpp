#include "geometry/leaf/point_leaf_distance.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/leaf/point_leaf_distance.cpp"
#include "simd/foreach_target.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

// The bounds decide in which order triangles are searched, and with that which of several results a
// search with a limit returns. They have the same bits on every processor: no operation is fused, since
// some processors cannot.
template <class D>
HWY_INLINE hn::Vec<D> unfused_dot(const Lanes3<D>& a, const Lanes3<D>& b) {
    return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}
template <class D>
HWY_INLINE Lanes3<D> unfused_cross(const Lanes3<D>& a, const Lanes3<D>& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
            hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

/// A vector from approximately the triangle's nearest point to the query point. In: w, from each
/// vertex to that point.
template <class D>
HWY_INLINE Lanes3<D> towards(D d, const Lanes3<D> (&w)[3], const Lanes3<D> (&edge)[3]) {
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F);
    const Lanes3<D> normal = unfused_cross(edge[0], edge[1]);
    Lanes3<D> best = w[0];
    auto best_sq = unfused_dot(best, best);
    auto within = hn::Gt(unfused_dot(normal, normal), zero);
    for (std::size_t i = 0; i < 3; ++i) {
        // A zero-length edge has its foot at its vertex: 0 / tiny.
        const auto length_sq = hn::Max(unfused_dot(edge[i], edge[i]), hn::Set(d, 0x1p-120F));
        const auto s = hn::Min(hn::Max(hn::Div(unfused_dot(w[i], edge[i]), length_sq), zero), one);
        const Lanes3<D>& e = edge[i];
        const Lanes3<D> gap =
            sub(w[i], Lanes3<D>{hn::Mul(s, e.x), hn::Mul(s, e.y), hn::Mul(s, e.z)});
        const auto sq = unfused_dot(gap, gap);
        best = if_then_else(hn::Lt(sq, best_sq), gap, best);
        best_sq = hn::Min(sq, best_sq);
        within = hn::And(within, hn::Ge(unfused_dot(unfused_cross(edge[i], w[i]), normal), zero));
    }
    // The normal, turned to the point's side.
    const auto sign = hn::CopySign(one, unfused_dot(normal, w[0]));
    const Lanes3<D> up{hn::Mul(sign, normal.x), hn::Mul(sign, normal.y), hn::Mul(sign, normal.z)};
    return if_then_else(within, up, best);
}

// For any n, the triangle is at least min over its vertices of n . w / |n| away, so the way n was
// found needs no error analysis. The errors are those of the scalar product, the length and the
// quotient, at most 12 roundings of the largest w, and those of the coordinates, at most sqrt(3)
// margins along n.
template <class D>
HWY_INLINE void distance_sq_lanes(D d, const TriangleLeaf& leaf, const std::array<float, 3>& point,
                                  float margin, std::size_t lane, float* lower_sq) {
    const Lanes3<D> p = set3(d, point);
    Lanes3<D> v[3], w[3], edge[3];
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = load3(d, leaf.v[i], lane);
        w[i] = sub(p, v[i]);
    }
    for (std::size_t i = 0; i < 3; ++i)
        edge[i] = sub(v[(i + 1) % 3], v[i]);
    const Lanes3<D> n = towards(d, w, edge);
    const auto along = min3(unfused_dot(n, w[0]), unfused_dot(n, w[1]), unfused_dot(n, w[2]));
    const auto largest = max3(max_abs(w[0]), max_abs(w[1]), max_abs(w[2]));
    const auto off =
        hn::Add(hn::Mul(hn::Set(d, 16 * 0x1p-24F), largest), hn::Set(d, 1.75F * margin));
    const auto nn = unfused_dot(n, n);
    const auto lower = hn::Sub(hn::Div(along, hn::Sqrt(nn)), off);
    // Nothing is certain where squares underflow or products of three coordinates overflow.
    const auto safe =
        hn::And(hn::And(hn::Gt(nn, hn::Set(d, 0x1p-100F)), hn::Gt(lower, hn::Set(d, 0x1p-50F))),
                hn::Lt(largest, hn::Set(d, 0x1p40F)));
    const auto certain = hn::IfThenElseZero(safe, lower);
    hn::StoreU(hn::Mul(hn::Set(d, 1 - 0x1p-20F), hn::Mul(certain, certain)), d, lower_sq + lane);
}

template <class D>
HWY_INLINE void distance_sq_with(D d, const TriangleLeaf& leaf, const std::array<float, 3>& point,
                                 float margin, float* lower_sq) {
    for (std::size_t lane = 0; lane < TriangleLeaf::kLanes; lane += hn::Lanes(d))
        distance_sq_lanes(d, leaf, point, margin, lane, lower_sq);
}

void distance_sq_simd(const TriangleLeaf& leaf, const std::array<float, 3>& point, float margin,
                      float* lower_sq) {
    distance_sq_with(hn::CappedTag<float, TriangleLeaf::kLanes>(), leaf, point, margin, lower_sq);
}
void distance_sq_one(const TriangleLeaf& leaf, const std::array<float, 3>& point, float margin,
                     float* lower_sq) {
    distance_sq_with(hn::CappedTag<float, 1>(), leaf, point, margin, lower_sq);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(distance_sq_simd);

void point_leaf_distance_sq(const TriangleLeaf& leaf, const std::array<float, 3>& point,
                            float margin, float (&lower_sq)[TriangleLeaf::kLanes]) {
    HWY_DYNAMIC_DISPATCH(distance_sq_simd)(leaf, point, margin, lower_sq);
}
void point_leaf_distance_sq_reference(const TriangleLeaf& leaf, const std::array<float, 3>& point,
                                      float margin, float (&lower_sq)[TriangleLeaf::kLanes]) {
    HWY_STATIC_DISPATCH(distance_sq_one)(leaf, point, margin, lower_sq);
}

} // namespace abut
#endif
