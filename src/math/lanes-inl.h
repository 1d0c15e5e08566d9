// Vectors of three coordinates, one vector in each SIMD lane.

// Included once for each target.
#if defined(ABUT_MATH_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_MATH_LANES_INL_H
#undef ABUT_MATH_LANES_INL_H
#else
#define ABUT_MATH_LANES_INL_H
#endif

#include "simd/simd.h"

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The coordinates of as many vectors as there are lanes.
template <class D>
struct Lanes3 {
    hn::Vec<D> x, y, z;
};

/// Loads vectors from three rows, starting at `lane`.
template <class D, typename T, std::size_t n>
HWY_INLINE Lanes3<D> load3(D d, const T (*row)[n], std::size_t lane) {
    return {hn::Load(d, row[0] + lane), hn::Load(d, row[1] + lane), hn::Load(d, row[2] + lane)};
}
/// The same vector in all lanes.
template <class D, typename T>
HWY_INLINE Lanes3<D> set3(D d, const std::array<T, 3>& v) {
    return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}

template <class D>
HWY_INLINE Lanes3<D> add(const Lanes3<D>& a, const Lanes3<D>& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
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
/// The largest magnitude of the coordinates.
template <class D>
HWY_INLINE hn::Vec<D> max_abs(const Lanes3<D>& a) {
    return hn::Max(hn::Abs(a.x), hn::Max(hn::Abs(a.y), hn::Abs(a.z)));
}
template <class D>
HWY_INLINE Lanes3<D> if_then_else(hn::Mask<D> mask, const Lanes3<D>& yes, const Lanes3<D>& no) {
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
            hn::IfThenElse(mask, yes.z, no.z)};
}

template <class V>
HWY_INLINE V min3(V a, V b, V c) {
    return hn::Min(a, hn::Min(b, c));
}
template <class V>
HWY_INLINE V max3(V a, V b, V c) {
    return hn::Max(a, hn::Max(b, c));
}

/// The bits of a mask of at most 16 lanes. The first lane has the lowest bit.
template <class D>
HWY_INLINE std::uint32_t bits_of(D d, hn::Mask<D> mask) {
    static_assert(hn::MaxLanes(D()) <= 16);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return (static_cast<std::uint32_t>(bits[0]) | static_cast<std::uint32_t>(bits[1]) << 8) &
           ((1U << hn::MaxLanes(d)) - 1);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
