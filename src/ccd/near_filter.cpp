#include "ccd/near_filter.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ccd/near_filter.cpp"
#include "simd/foreach_target.h"
// Included once for each target:
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace near_lanes {

/// The vertices of pairs of features, and the limits of their distances.
template <class D>
struct Pairs {
    Lanes3<D> p[4];
    hn::Vec<D> limit;

    HWY_INLINE Pairs(D d, const NearBatch& batch, std::size_t lane)
        : limit(hn::Load(d, batch.limit + lane)) {
        for (std::size_t i = 0; i < 4; ++i)
            p[i] = load3(d, batch.v[i], lane);
    }
};

/// Lanes whose features are farther apart than the limit along one axis. A rounded difference above
/// the limit was above it before rounding.
template <bool faces, class D>
HWY_INLINE hn::Mask<D> apart_along(hn::Vec<D> s0, hn::Vec<D> s1, hn::Vec<D> s2, hn::Vec<D> s3,
                                   hn::Vec<D> limit) {
    if constexpr (faces)
        return hn::Or(hn::Gt(hn::Sub(min3(s1, s2, s3), s0), limit),
                      hn::Gt(hn::Sub(s0, max3(s1, s2, s3)), limit));
    else
        return hn::Or(hn::Gt(hn::Sub(hn::Min(s2, s3), hn::Max(s0, s1)), limit),
                      hn::Gt(hn::Sub(hn::Min(s0, s1), hn::Max(s2, s3)), limit));
}

template <bool faces, class D>
HWY_INLINE hn::Mask<D> apart_on_axes(const Pairs<D>& pairs) {
    const auto& p = pairs.p;
    return hn::Or(apart_along<faces, D>(p[0].x, p[1].x, p[2].x, p[3].x, pairs.limit),
                  hn::Or(apart_along<faces, D>(p[0].y, p[1].y, p[2].y, p[3].y, pairs.limit),
                         apart_along<faces, D>(p[0].z, p[1].z, p[2].z, p[3].z, pairs.limit)));
}

template <class D>
HWY_INLINE hn::Vec<D> in_unit(D d, hn::Vec<D> x) {
    return hn::Min(hn::Max(x, hn::Zero(d)), hn::Set(d, 1.0));
}

/// num / den in [0, 1]; 0 if den is 0.
template <class D>
HWY_INLINE hn::Vec<D> ratio(D d, hn::Vec<D> num, hn::Vec<D> den) {
    return hn::IfThenElseZero(hn::Gt(den, hn::Zero(d)), in_unit(d, hn::Div(num, den)));
}

/// The point of the segment from `a` along `side` that is nearest to the origin, approximately.
template <class D>
HWY_INLINE Lanes3<D> nearest_on_segment(D d, const Lanes3<D>& a, const Lanes3<D>& side) {
    const auto t = ratio(d, hn::Neg(dot<D>(a, side)), dot<D>(side, side));
    return plus_scaled<D>(a, t, side);
}

/// The corners of the patch of difference_patch.h, and approximately its point nearest to the origin.
template <class D>
struct Separation {
    Lanes3<D> corner[4];
    Lanes3<D> point; ///< a point of the patch, to rounding
    Lanes3<D>
        gap; ///< the same, where that is known with more digits; its direction tells the features
             ///< apart
};

template <class D>
HWY_INLINE Lanes3<D> scaled(hn::Vec<D> s, const Lanes3<D>& v) {
    return {hn::Mul(s, v.x), hn::Mul(s, v.y), hn::Mul(s, v.z)};
}

template <class D>
HWY_INLINE Separation<D> face_separation(D d, const Pairs<D>& pairs) {
    Separation<D> s;
    for (std::size_t i = 0; i < 3; ++i)
        s.corner[i] = sub<D>(pairs.p[i + 1], pairs.p[0]);
    s.corner[3] = s.corner[0];
    const Lanes3<D>& c = s.corner[0];
    const auto x = sub<D>(s.corner[1], c), y = sub<D>(s.corner[2], c), n = cross<D>(x, y);
    // The nearest point of the border, and the foot in the face's plane.
    s.point = nearest_on_segment(d, c, x);
    auto least = dot<D>(s.point, s.point);
    const auto keep_nearer = [&](const Lanes3<D>& other) HWY_ATTR {
        const auto sq = dot<D>(other, other);
        s.point = if_then_else<D>(hn::Lt(sq, least), other, s.point);
        least = hn::Min(least, sq);
    };
    keep_nearer(nearest_on_segment(d, c, y));
    keep_nearer(nearest_on_segment(d, s.corner[1], sub<D>(s.corner[2], s.corner[1])));
    // Weights of the foot, times the square of n.
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0), nn = dot<D>(n, n);
    const auto g = dot<D>(cross<D>(y, c), n), h = dot<D>(cross<D>(c, x), n);
    const auto inside = hn::And(hn::And(hn::Ge(g, zero), hn::Ge(h, zero)),
                                hn::And(hn::Le(hn::Add(g, h), nn), hn::Gt(nn, zero)));
    const auto along_x = ratio(d, g, nn), along_y = hn::Min(ratio(d, h, nn), hn::Sub(one, along_x));
    const auto foot = plus_scaled<D>(plus_scaled<D>(c, along_x, x), along_y, y);
    s.gap = if_then_else<D>(inside, scaled<D>(hn::Div(dot<D>(c, n), nn), n), s.point);
    s.point = if_then_else<D>(inside, foot, s.point);
    return s;
}

template <class D>
HWY_INLINE Separation<D> edge_separation(D d, const Pairs<D>& pairs) {
    Separation<D> s;
    const auto& p = pairs.p;
    s.corner[0] = sub<D>(p[2], p[0]);
    s.corner[1] = sub<D>(p[2], p[1]);
    s.corner[2] = sub<D>(p[3], p[1]);
    s.corner[3] = sub<D>(p[3], p[0]);
    const auto u = sub<D>(p[1], p[0]), v = sub<D>(p[3], p[2]), r = s.corner[0];
    const auto uu = dot<D>(u, u), vv = dot<D>(v, v), uv = dot<D>(u, v), ru = dot<D>(r, u),
               rv = dot<D>(r, v);
    // The parameter along u of the lines' nearest points, then that along v, then again that along
    // u, because v's may have been clamped.
    const auto across = hn::Sub(hn::Mul(uu, vv), hn::Mul(uv, uv));
    const auto first = ratio(d, hn::Sub(hn::Mul(ru, vv), hn::Mul(rv, uv)), across);
    const auto t = ratio(d, hn::Sub(hn::Mul(first, uv), rv), vv);
    const auto again = ratio(d, hn::MulAdd(t, uv, ru), uu);
    s.point = minus_scaled<D>(plus_scaled<D>(r, t, v), again, u);
    // Between inner points of both edges the gap is along their common perpendicular, which loses
    // fewer digits than the difference of two points.
    const auto n = cross<D>(u, v);
    const auto nn = dot<D>(n, n), zero = hn::Zero(d), one = hn::Set(d, 1.0);
    const auto inside = hn::And(hn::And(hn::Gt(again, zero), hn::Lt(again, one)),
                                hn::And(hn::Gt(t, zero), hn::Lt(t, one)));
    const auto both = hn::And(inside, hn::Gt(nn, hn::Mul(hn::Set(d, 1e-12), hn::Mul(uu, vv))));
    s.gap = if_then_else<D>(both, scaled<D>(hn::Div(dot<D>(r, n), nn), n), s.point);
    return s;
}

template <class D>
struct NearMasks {
    hn::Mask<D> beyond; ///< farther apart than the limit
    hn::Mask<D> within;
};

/// Compares bounds of the distance with the limit.
///
/// Let eps = 2^-53, and M the largest coordinate of the corners. A corner's coordinate is off by eps M.
/// Beyond: the unit direction's coordinates sum to at most 1.733, and three roundings of its product
/// with a corner add 5.2 eps M. The direction's length exceeds 1 by at most 6 eps. So 16 eps M and a
/// factor of 1 + 16 eps on the limit cover all. Within: a coordinate of the point is off by at most 12
/// eps M, for sides of at most 2 M and weights that sum to at most 1 + eps, and its length by 21 eps
/// M; the square and its root are off by 4 eps of themselves. Where squares overflow or underflow,
/// nothing is certain; numbers that are not finite compare as false.
template <class D>
HWY_INLINE NearMasks<D> compare(D d, const Separation<D>& s, hn::Vec<D> limit) {
    auto size = max_abs<D>(s.corner[0]);
    for (std::size_t i = 1; i < 4; ++i)
        size = hn::Max(size, max_abs<D>(s.corner[i]));
    const auto tiny = hn::Set(d, 0x1p-900), huge = hn::Set(d, 0x1p900);
    const auto rounding = hn::Mul(hn::Set(d, 16 * 0x1p-53), hn::Add(size, limit));

    const auto sq = dot<D>(s.gap, s.gap);
    const auto n = scaled<D>(hn::Div(hn::Set(d, 1.0), hn::Sqrt(sq)), s.gap);
    auto least = dot<D>(n, s.corner[0]);
    for (std::size_t i = 1; i < 4; ++i)
        least = hn::Min(least, dot<D>(n, s.corner[i]));
    const auto in_range = hn::And(hn::And(hn::Gt(sq, tiny), hn::Lt(sq, huge)), hn::Lt(size, huge));

    // Squares that underflow, of lengths below 2^-511, matter to no limit above 2^-450.
    const auto most = hn::MulAdd(hn::Set(d, 3.0), rounding, hn::Sqrt(dot<D>(s.point, s.point)));
    const auto usable = hn::And(hn::Gt(limit, hn::Set(d, 0x1p-450)), hn::Lt(size, huge));
    return {hn::And(in_range, hn::Gt(least, hn::Add(limit, rounding))),
            hn::And(usable, hn::Le(most, limit))};
}

template <bool faces, class D>
HWY_INLINE NearMasks<D> masks_of(D d, const Pairs<D>& pairs) {
    const auto far = apart_on_axes<faces, D>(pairs);
    if (hn::AllTrue(d, far))
        return {far, hn::Not(far)};
    NearMasks<D> masks;
    if constexpr (faces)
        masks = compare(d, face_separation(d, pairs), pairs.limit);
    else
        masks = compare(d, edge_separation(d, pairs), pairs.limit);
    masks.beyond = hn::Or(masks.beyond, far);
    return masks;
}

template <class D>
HWY_INLINE NearBits bits_with(D d, const NearBatch& batch, bool faces) {
    NearBits bits;
    for (std::size_t lane = 0; lane < NearBatch::kLanes; lane += hn::Lanes(d)) {
        const Pairs<D> pairs(d, batch, lane);
        const NearMasks<D> masks = faces ? masks_of<true>(d, pairs) : masks_of<false>(d, pairs);
        bits.possible |= bits_of(d, hn::Not(masks.beyond)) << lane;
        bits.certain |= bits_of(d, masks.within) << lane;
    }
    return bits;
}

} // namespace near_lanes

NearBits near_filter_simd(const NearBatch& batch, bool faces) {
    return near_lanes::bits_with(hn::CappedTag<double, NearBatch::kLanes>(), batch, faces);
}
NearBits near_filter_single(const NearBatch& batch, bool faces) {
    return near_lanes::bits_with(hn::CappedTag<double, 1>(), batch, faces);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(near_filter_simd);

NearBits near_filter(const NearBatch& batch, ElementaryKind kind) {
    return HWY_DYNAMIC_DISPATCH(near_filter_simd)(batch, kind == ElementaryKind::vertex_face);
}
NearBits near_filter_reference(const NearBatch& batch, ElementaryKind kind) {
    return HWY_STATIC_DISPATCH(near_filter_single)(batch, kind == ElementaryKind::vertex_face);
}

} // namespace abut
#endif
