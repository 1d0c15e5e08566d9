#pragma once

#include "math/vector.h"

#include <boost/multiprecision/cpp_int.hpp>

namespace abut {

/// An integer times a power of two. Sums, differences and products of finite doubles are exact.
/// Used where a filter could not decide; not tuned for speed.
class Dyadic {
public:
    Dyadic() = default;
    Dyadic(double value); // NOLINT: implicit, so that formulas read as they do for doubles

    [[nodiscard]] int sign() const { return mantissa_.sign(); }

    friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
    friend Dyadic operator-(const Dyadic& a, const Dyadic& b);
    friend Dyadic operator-(const Dyadic& a);
    friend Dyadic operator*(const Dyadic& a, const Dyadic& b);

    /// a / b, where b is not zero.
    /// Accuracy    within one unit in the last place.
    friend double quotient(const Dyadic& a, const Dyadic& b);

private:
    using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                                  boost::multiprecision::et_off>;
    Dyadic(Integer mantissa, int exponent) : mantissa_(std::move(mantissa)), exponent_(exponent) {}
    /// The mantissa over a smaller power of two.
    [[nodiscard]] Integer over(int exponent) const { return mantissa_ << (exponent_ - exponent); }

    Integer mantissa_;
    int exponent_ = 0;
};

/// A vector of dyadic numbers.
struct DyadicVec3 {
    Dyadic x, y, z;
    DyadicVec3() = default;
    DyadicVec3(Dyadic a, Dyadic b, Dyadic c) : x(std::move(a)), y(std::move(b)), z(std::move(c)) {}
    explicit DyadicVec3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
};

inline DyadicVec3 operator-(const DyadicVec3& a, const DyadicVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Dyadic dot(const DyadicVec3& a, const DyadicVec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline DyadicVec3 cross(const DyadicVec3& a, const DyadicVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

} // namespace abut
