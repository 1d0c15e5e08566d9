#include "math/integer_polynomial.h"

#include <utility>

namespace abut {

namespace {

constexpr std::size_t kCoefficients = 4;

/// Bernstein coefficients of degree 3 over [0, 1], times 3. Raising the degree of a polynomial adds
/// no change of sign.
std::array<BigInt, kCoefficients> bernstein(const IntegerPolynomial& p) {
    const BigInt first = 3 * p.c[0], second = first + p.c[1];
    const BigInt third = second + p.c[1] + p.c[2];
    return {first, second, third, BigInt(3 * (p.c[0] + p.c[1] + p.c[2] + p.c[3]))};
}

/// Pseudo-division: subtracts shifted multiples of the divisor from p until its degree is less than
/// the divisor's. Each step multiplies p by the divisor's leading coefficient. The quotient is
/// stored in `quotient` unless it is null.
void divide(IntegerPolynomial& p, const IntegerPolynomial& divisor, IntegerPolynomial* quotient) {
    const int degree = divisor.degree();
    const auto top = static_cast<std::size_t>(degree);
    const BigInt& lead = divisor.c[top];
    for (int i = p.degree(); i >= degree; --i) {
        const auto shift = static_cast<std::size_t>(i - degree);
        const BigInt factor = p.c[static_cast<std::size_t>(i)];
        for (BigInt& c : p.c)
            c *= lead;
        if (quotient != nullptr) {
            for (BigInt& c : quotient->c)
                c *= lead;
            quotient->c[shift] = factor;
        }
        for (std::size_t k = 0; k <= top; ++k)
            p.c[k + shift] -= factor * divisor.c[k];
    }
}

} // namespace

int IntegerPolynomial::degree() const {
    for (int i = 3; i >= 0; --i)
        if (!c[static_cast<std::size_t>(i)].is_zero())
            return i;
    return -1;
}

int IntegerPolynomial::sign_at_one() const {
    return BigInt(c[0] + c[1] + c[2] + c[3]).sign();
}

IntegerPolynomial operator+(const IntegerPolynomial& a, const IntegerPolynomial& b) {
    return {{a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2], a.c[3] + b.c[3]}};
}

IntegerPolynomial operator-(const IntegerPolynomial& a, const IntegerPolynomial& b) {
    return {{a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2], a.c[3] - b.c[3]}};
}

IntegerPolynomial operator*(const IntegerPolynomial& a, const IntegerPolynomial& b) {
    IntegerPolynomial product;
    for (std::size_t i = 0; i < kCoefficients; ++i)
        for (std::size_t k = 0; i + k < kCoefficients; ++k)
            if (!a.c[i].is_zero() && !b.c[k].is_zero())
                product.c[i + k] += a.c[i] * b.c[k];
    return product;
}

IntegerPolynomial derivative(const IntegerPolynomial& p) {
    return {{p.c[1], 2 * p.c[2], 3 * p.c[3], BigInt(0)}};
}

IntegerPolynomial common_divisor(IntegerPolynomial a, IntegerPolynomial b) {
    // Euclid's algorithm. Degrees are too small for the coefficients to explode.
    while (!b.is_zero()) {
        divide(a, b, nullptr);
        std::swap(a, b);
    }
    return a;
}

IntegerPolynomial quotient(IntegerPolynomial p, const IntegerPolynomial& divisor) {
    IntegerPolynomial result;
    divide(p, divisor, &result);
    return result;
}

IntegerPolynomial restricted(const IntegerPolynomial& p, const BigInt& index, unsigned level) {
    const int degree = p.degree();
    IntegerPolynomial r = p;
    // Substitutes t = x / 2^level. Then Horner's scheme shifts by `index`.
    for (int i = 0; i < degree; ++i)
        r.c[static_cast<std::size_t>(i)] <<= level * static_cast<unsigned>(degree - i);
    for (int first = 0; first < degree; ++first)
        for (int i = degree - 1; i >= first; --i)
            r.c[static_cast<std::size_t>(i)] += index * r.c[static_cast<std::size_t>(i) + 1];
    return r;
}

int sign_variations(const IntegerPolynomial& p) {
    int variations = 0, last = 0;
    for (const BigInt& b : bernstein(p)) {
        const int sign = b.sign();
        variations += sign * last < 0 ? 1 : 0;
        last = sign != 0 ? sign : last;
    }
    return variations;
}

int certain_sign(const IntegerPolynomial& p) {
    const auto b = bernstein(p);
    const int sign = b[0].sign();
    for (const BigInt& each : b)
        if (each.sign() != sign)
            return 0;
    return sign;
}

} // namespace abut
