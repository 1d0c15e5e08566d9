// Vectors, lanes wide, and gaps between volumes: what the kernels share.

// Included once for each target.
#if defined(ABUT_VOLUME_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_VOLUME_LANES_INL_H
#undef ABUT_VOLUME_LANES_INL_H
#else
#define ABUT_VOLUME_LANES_INL_H
#endif

#include "simd/simd.h"
#include "volume/lower_bound.h"

#include <array>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::volumes {

namespace hn = hwy::HWY_NAMESPACE;

/// Three coordinates, lanes wide.
template <class D>
struct Lanes3 {
    hn::Vec<D> x, y, z;
};
template <class D>
HWY_INLINE Lanes3<D> load3(D d, const float (*row)[VolumeBounds::kLanes], std::size_t lane) {
    return {hn::Load(d, row[0] + lane), hn::Load(d, row[1] + lane), hn::Load(d, row[2] + lane)};
}
template <class D>
HWY_INLINE Lanes3<D> set3(D d, const std::array<float, 3>& v) {
    return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}
template <class D>
HWY_INLINE Lanes3<D> sub(const Lanes3<D>& a, const Lanes3<D>& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class D>
HWY_INLINE hn::Vec<D> dot(const Lanes3<D>& a, const Lanes3<D>& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class D>
HWY_INLINE Lanes3<D> cross(const Lanes3<D>& a, const Lanes3<D>& b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
/// a + s b
template <class D>
HWY_INLINE Lanes3<D> plus_scaled(const Lanes3<D>& a, hn::Vec<D> s, const Lanes3<D>& b) {
    return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}
/// a - s b
template <class D>
HWY_INLINE Lanes3<D> minus_scaled(const Lanes3<D>& a, hn::Vec<D> s, const Lanes3<D>& b) {
    return {hn::NegMulAdd(s, b.x, a.x), hn::NegMulAdd(s, b.y, a.y), hn::NegMulAdd(s, b.z, a.z)};
}
template <class D>
HWY_INLINE hn::Vec<D> clamp_to(hn::Vec<D> v, hn::Vec<D> half) {
    return hn::Max(hn::Neg(half), hn::Min(v, half));
}

/// A gap between two volumes of each lane: along one direction, and squared of several together.
template <class D>
struct Separation {
    hn::Vec<D> gap;      ///< widest along a direction; margin taken off
    hn::Vec<D> lower_sq; ///< squared distance, at least
};

/// Squares of gaps are rounded a few times.
constexpr float kSquareRounding = 1 - 32 * 0x1p-24F;

template <class D>
HWY_INLINE hn::Vec<D> square_of_gap(D d, hn::Vec<D> gap) {
    const auto open = hn::Max(gap, hn::Zero(d));
    return hn::Mul(open, open);
}

} // namespace abut::HWY_NAMESPACE::volumes
HWY_AFTER_NAMESPACE();

#endif
