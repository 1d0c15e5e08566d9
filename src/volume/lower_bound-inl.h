// Kernels that bound the distance between one volume and several. They are included by sources that
// compile themselves for each SIMD target (simd/simd.h), so that traversals have them inline.

// Included once for each target.
#if defined(ABUT_VOLUME_LOWER_BOUND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_VOLUME_LOWER_BOUND_INL_H
#undef ABUT_VOLUME_LOWER_BOUND_INL_H
#else
#define ABUT_VOLUME_LOWER_BOUND_INL_H
#endif

#include "volume/axis_gap-inl.h"
#include "volume/kdop-inl.h"
#include "volume/lower_bound.h"
#include "volume/obb-inl.h"
#include "volume/ssv-inl.h"
#include "volume/swept_sphere-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::volumes {

/// A ball around the volume in each lane of a batch.
template <class D>
struct LanesBall {
    Lanes3<D> centre;
    hn::Vec<D> radius;
};
template <class D>
HWY_INLINE LanesBall<D> ball_around_core(D d, const float (*row)[VolumeBounds::kLanes],
                                         std::size_t lane, std::size_t n) {
    auto sum_sq = hn::Zero(d);
    for (std::size_t i = 0; i < n; ++i) {
        const auto half = hn::Load(d, row[4 + 4 * i + 3] + lane);
        sum_sq = hn::MulAdd(half, half, sum_sq);
    }
    return {load3(d, row, lane), hn::Add(hn::Sqrt(sum_sq), hn::Load(d, row[3] + lane))};
}
template <class D, std::size_t n>
HWY_INLINE LanesBall<D> ball_around(D d, const VolumeBatch<SweptSphere<n>>& batch,
                                    std::size_t lane) {
    return ball_around_core(d, batch.row, lane, n);
}
template <class D>
HWY_INLINE LanesBall<D> ball_around(D d, const VolumeBatch<BoundingSphere>& batch,
                                    std::size_t lane) {
    return ball_around_core(d, batch.row, lane, 0);
}
template <class D>
HWY_INLINE LanesBall<D> ball_around(D d, const VolumeBatch<Ssv>& batch, std::size_t lane) {
    return ball_around_core(d, batch.row, lane, 2);
}
template <class D>
HWY_INLINE LanesBall<D> ball_around(D d, const SweptBatch& batch, std::size_t lane) {
    return ball_around_core(d, batch.row, lane, batch.most_dimension);
}
template <class D>
HWY_INLINE LanesBall<D> ball_around(D d, const VolumeBatch<Obb>& batch, std::size_t lane) {
    const Lanes3<D> half = load3(d, batch.row + 12, lane);
    return {load3(d, batch.row, lane), hn::Sqrt(dot(half, half))};
}
template <class D, std::size_t k>
HWY_INLINE LanesBall<D> ball_around(D d, const VolumeBatch<Kdop<k>>& batch, std::size_t lane) {
    const Lanes3<D> lower = load3(d, batch.row, lane), upper = load3(d, batch.row + k / 2, lane);
    const auto half = hn::Set(d, 0.5F);
    const Lanes3<D> extent = sub(upper, lower);
    return {{hn::Mul(half, hn::Add(lower.x, upper.x)), hn::Mul(half, hn::Add(lower.y, upper.y)),
             hn::Mul(half, hn::Add(lower.z, upper.z))},
            hn::Mul(half, hn::Sqrt(dot(extent, extent)))};
}

struct ImageBall {
    std::array<float, 3> centre;
    float radius;
};
template <std::size_t n>
HWY_INLINE ImageBall ball_around(const SweptSphereImage<n>& image) {
    return {image.swept.centre, image.circumradius};
}
HWY_INLINE ImageBall ball_around(const ObbImage& image) {
    return {image.centre, image.circumradius};
}
template <std::size_t k>
HWY_INLINE ImageBall ball_around(const KdopImage<k>& image) {
    ImageBall ball{{}, image.kdop.circumradius()};
    for (std::size_t i = 0; i < 3; ++i)
        ball.centre[i] = 0.5F * (image.kdop.lower[i] + image.kdop.upper[i]);
    return ball;
}

/// Bounds the distances of `one` to all volumes of the batch. Without `with_upper`, upper_sq is
/// left unchanged.
template <bool with_upper, class D, class Batch, class Image>
HWY_INLINE void bound_all(D d, const Batch& batch, const Image& one, VolumeBounds& bounds) {
    ImageBall other{};
    if constexpr (with_upper)
        other = ball_around(one);
    for (std::size_t lane = 0; lane < VolumeBounds::kLanes; lane += hn::Lanes(d)) {
        const Separation<D> s = separation(d, batch, lane, one);
        hn::Store(hn::Mul(s.lower_sq, hn::Set(d, kSquareRounding)), d, bounds.lower_sq + lane);
        hn::Store(s.gap, d, bounds.gap + lane);
        if constexpr (with_upper) {
            const LanesBall<D> own = ball_around(d, batch, lane);
            const Lanes3<D> w = sub(set3(d, other.centre), own.centre);
            const auto reach = hn::Add(hn::Add(hn::Sqrt(dot(w, w)), own.radius),
                                       hn::Set(d, other.radius + one.margin));
            hn::Store(hn::Mul(hn::Mul(reach, reach), hn::Set(d, 2 - kSquareRounding)), d,
                      bounds.upper_sq + lane);
        }
    }
}

} // namespace abut::HWY_NAMESPACE::volumes
HWY_AFTER_NAMESPACE();

#endif
