#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace abut {

/// An integer of any size. Up to 512 bits it needs no memory allocation.
using BigInt = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<512, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked,
                                           std::allocator<boost::multiprecision::limb_type>>,
    boost::multiprecision::et_off>;

/// c[0] + c[1] t + c[2] t^2 + c[3] t^3 with integer coefficients.
struct IntegerPolynomial {
    std::array<BigInt, 4> c;

    /// The degree; -1 for the zero polynomial.
    [[nodiscard]] int degree() const;
    [[nodiscard]] bool is_zero() const { return degree() < 0; }
    /// Sign at t = 1.
    [[nodiscard]] int sign_at_one() const;
};

IntegerPolynomial operator+(const IntegerPolynomial& a, const IntegerPolynomial& b);
IntegerPolynomial operator-(const IntegerPolynomial& a, const IntegerPolynomial& b);
/// In          the product's degree is at most 3.
IntegerPolynomial operator*(const IntegerPolynomial& a, const IntegerPolynomial& b);

IntegerPolynomial derivative(const IntegerPolynomial& p);

/// A greatest common divisor, up to a constant factor. In: not both zero.
IntegerPolynomial common_divisor(IntegerPolynomial a, IntegerPolynomial b);

/// p / divisor up to a constant factor. In: the division leaves no remainder.
IntegerPolynomial quotient(IntegerPolynomial p, const IntegerPolynomial& divisor);

/// 2^(degree level) p((index + u) / 2^level) as a polynomial in u. It describes p in one cell of a
/// dyadic grid, where u is in [0, 1].
IntegerPolynomial restricted(const IntegerPolynomial& p, const BigInt& index, unsigned level);

/// Number of sign changes among the Bernstein coefficients over [0, 1], ignoring zeros. It is at
/// least the number of roots in the open interval, counted with multiplicity, and differs from that
/// by an even number.
int sign_variations(const IntegerPolynomial& p);

/// The sign of p on all of [0, 1], if its Bernstein coefficients have the same sign; otherwise 0.
int certain_sign(const IntegerPolynomial& p);

/// The values scaled by one power of two so that the largest is a double of full precision. Only
/// their ratios are meaningful.
template <std::size_t n>
std::array<double, n> common_scale(const std::array<BigInt, n>& values) {
    unsigned bits = 0;
    for (const BigInt& v : values)
        if (!v.is_zero())
            bits = std::max(bits, static_cast<unsigned>(msb(abs(v))) + 1);
    const unsigned shift = bits > 62 ? bits - 62 : 0;
    std::array<double, n> result{};
    for (std::size_t i = 0; i < n; ++i) {
        const auto magnitude =
            static_cast<double>(static_cast<std::uint64_t>(BigInt(abs(values[i]) >> shift)));
        result[i] = values[i].sign() < 0 ? -magnitude : magnitude;
    }
    return result;
}

} // namespace abut
