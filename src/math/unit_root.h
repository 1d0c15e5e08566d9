#pragma once

#include "math/integer_polynomial.h"

#include <vector>

namespace abut {

/// A real root in [0, 1] of a polynomial with integer coefficients: an algebraic number, known by
/// the polynomial and a dyadic cell that holds this root alone and can be halved at will.
///
/// Source      isolation by Descartes' rule in the Bernstein basis [Lane, Riesenfeld 1981]; signs at
///             a root by common divisors, as [Basu, Pollack, Roy 2006, 10.4].
class UnitRoot {
public:
    /// The root is index / 2^level.
    UnitRoot(BigInt index, unsigned level);
    /// The root is the only one of `local` in the open cell (index, index + 1) / 2^level. In:
    /// `square_free` is in t and has no multiple root; `local` in the cell's u, and not zero at its
    /// left end.
    UnitRoot(IntegerPolynomial square_free, IntegerPolynomial local, BigInt index, unsigned level);

    /// Sign of p at the root: exact. Refines the cell as far as that takes.
    int sign_of(const IntegerPolynomial& p);

    /// Makes the cell as small as 2^-level.
    void refine(unsigned level);

    /// The cell's left end, rounded down if it has more than 53 bits: not above the root.
    [[nodiscard]] double lower_bound() const;
    /// p at the left end of the cell, times 2^(degree level). In: degree is at least p's.
    [[nodiscard]] BigInt value_at_left(const IntegerPolynomial& p, int degree) const;

private:
    void halve();
    /// Halves so many times at once, to where double precision sees the root; false, and nothing
    /// done, if it is not there.
    bool jump(unsigned halvings);

    IntegerPolynomial square_free_, local_;
    BigInt index_;
    unsigned level_ = 0;
    bool dyadic_ = false; ///< the root is the cell's left end
};

/// All roots of p in [0, 1], each once, from the least to the greatest. In: p is not zero.
std::vector<UnitRoot> unit_roots(const IntegerPolynomial& p);

} // namespace abut
