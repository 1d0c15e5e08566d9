#include "math/dyadic.h"

#include "math/scaled_integers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace abut {

Dyadic::Dyadic(double value) {
    const Binary binary = decompose(value);
    mantissa_ = binary.mantissa;
    exponent_ = binary.exponent;
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
    if (a.sign() == 0 || b.sign() == 0)
        return a.sign() == 0 ? b : a;
    const int exponent = std::min(a.exponent_, b.exponent_);
    return {a.over(exponent) + b.over(exponent), exponent};
}

Dyadic operator-(const Dyadic& a) {
    return {-a.mantissa_, a.exponent_};
}

Dyadic operator-(const Dyadic& a, const Dyadic& b) {
    return a + -b;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    return {a.mantissa_ * b.mantissa_, a.exponent_ + b.exponent_};
}

double quotient(const Dyadic& a, const Dyadic& b) {
    if (a.sign() == 0)
        return 0;
    Dyadic::Integer numerator = abs(a.mantissa_), denominator = abs(b.mantissa_);
    int exponent = a.exponent_ - b.exponent_;
    // The integer quotient has 64 or 65 bits. Its last bit is below half a unit of a double's last
    // place.
    const int shift = 64 + static_cast<int>(msb(denominator)) - static_cast<int>(msb(numerator));
    if (shift > 0)
        numerator <<= shift;
    else
        denominator <<= -shift;
    exponent -= shift;
    Dyadic::Integer ratio = numerator / denominator;
    const double magnitude = std::ldexp(
        static_cast<double>(static_cast<std::uint64_t>(Dyadic::Integer(ratio >> 1))), exponent + 1);
    return a.sign() == b.sign() ? magnitude : -magnitude;
}

} // namespace abut
