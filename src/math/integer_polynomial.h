#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>

namespace abut {

/// Any integer; up to 512 bits without a memory allocation.
using BigInt = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<512, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked,
                                           std::allocator<boost::multiprecision::limb_type>>,
    boost::multiprecision::et_off>;

/// c[0] + c[1] t + c[2] t^2 + c[3] t^3 with integer coefficients.
struct IntegerPolynomial {
    std::array<BigInt, 4> c;

    /// -1 for the zero polynomial.
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

/// 2^(degree level) p((index + u) / 2^level) as a polynomial in u: p as seen in one cell of a
/// dyadic grid, u in [0, 1].
IntegerPolynomial restricted(const IntegerPolynomial& p, const BigInt& index, unsigned level);

/// Changes of sign among the Bernstein coefficients over [0, 1], zeros left out: at least the number of roots
/// in the open interval (with multiplicity), and odd if that is odd.
int sign_variations(const IntegerPolynomial& p);

/// The sign that p has on all of [0, 1] as its Bernstein coefficients tell; 0 if they do not tell.
int certain_sign(const IntegerPolynomial& p);

} // namespace abut
