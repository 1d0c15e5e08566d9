// A vector of three coordinates in one register, for kernels that work on a few vectors at a time.

// Included once for each target.
#if defined(ABUT_MATH_XYZ_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_MATH_XYZ_INL_H
#undef ABUT_MATH_XYZ_INL_H
#else
#define ABUT_MATH_XYZ_INL_H
#endif

#include "math/vector.h"
#include "simd/simd.h"

#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Three coordinates and an unused fourth. Each operation rounds as that on Vec3 does, so that
/// results are the same on all targets. The type is the compiler's vector type, not Highway's,
/// whose vectors are no wider than a register. If registers hold only two doubles, the compiler
/// uses two registers.
struct alignas(32) Xyz {
    using Lanes = double __attribute__((vector_size(32)));

    Lanes lanes{};

    [[nodiscard]] HWY_INLINE double x() const { return lanes[0]; }
    [[nodiscard]] HWY_INLINE double y() const { return lanes[1]; }
    [[nodiscard]] HWY_INLINE double z() const { return lanes[2]; }
};

HWY_INLINE Xyz to_xyz(const Vec3& v) {
    return {Xyz::Lanes{v.x, v.y, v.z, 0}};
}
HWY_INLINE Vec3 to_vec3(const Xyz& v) {
    return {v.x(), v.y(), v.z()};
}
/// Loads from four consecutive numbers.
HWY_INLINE Xyz load_xyz(const double* numbers) {
    Xyz v;
    std::memcpy(&v.lanes, numbers, sizeof v.lanes);
    return v;
}

HWY_INLINE Xyz operator+(const Xyz& a, const Xyz& b) {
    return {a.lanes + b.lanes};
}
HWY_INLINE Xyz operator-(const Xyz& a, const Xyz& b) {
    return {a.lanes - b.lanes};
}
HWY_INLINE Xyz operator-(const Xyz& a) {
    return {-a.lanes};
}
HWY_INLINE Xyz operator*(double s, const Xyz& a) {
    return {s * a.lanes};
}
HWY_INLINE double dot(const Xyz& a, const Xyz& b) {
    const Xyz products{a.lanes * b.lanes};
    return products.x() + products.y() + products.z();
}
HWY_INLINE Xyz cross(const Xyz& a, const Xyz& b) {
    const auto turn = [](const Xyz::Lanes& v)
                          HWY_ATTR { return __builtin_shufflevector(v, v, 1, 2, 0, 3); };
    return {turn(a.lanes * turn(b.lanes) - turn(a.lanes) * b.lanes)};
}
HWY_INLINE double length_sq(const Xyz& a) {
    return dot(a, a);
}
HWY_INLINE Xyz choose(bool first, const Xyz& a, const Xyz& b) {
    return {first ? a.lanes : b.lanes};
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
