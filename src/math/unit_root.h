#pragma once

#include "math/integer_polynomial.h"

#include <vector>

namespace abut {

/// A real root in [0, 1] of a polynomial with integer coefficients. This algebraic number is
/// represented by the polynomial and a dyadic cell that contains only this root. The cell can be
/// halved any number of times.
///
/// Source      isolation by Descartes' rule in the Bernstein basis [Lane, Riesenfeld 1981]; signs
///             at a root by common divisors, as [Basu, Pollack, Roy 2006, 10.4].
class UnitRoot {
public:
    /// The root is index / 2^level.
    UnitRoot(BigInt index, unsigned level);
    /// The root is the only root of `local` in the open cell (index, index + 1) / 2^level. In:
    /// `square_free` is a polynomial in t without multiple roots. `local` is in the cell's
    /// coordinate u and not zero at the cell's left end.
    UnitRoot(IntegerPolynomial square_free, IntegerPolynomial local, BigInt index, unsigned level);

    /// The exact sign of p at the root. Refines the cell as far as needed.
    int sign_of(const IntegerPolynomial& p);

    /// Refines the cell to a size of at most 2^-level.
    void refine(unsigned level);

    /// A lower bound of the root: the cell's left end, rounded down if it has more than 53 bits.
    [[nodiscard]] double lower_bound() const;
    /// p at the left end of the cell, times 2^(degree level). In: degree is at least p's degree.
    [[nodiscard]] BigInt value_at_left(const IntegerPolynomial& p, int degree) const;

private:
    void halve();
    /// Halves the cell `halvings` times at once, at the root's place in double precision. Returns
    /// false and changes nothing if the root is not there.
    bool jump(unsigned halvings);

    IntegerPolynomial square_free_, local_;
    BigInt index_;
    unsigned level_ = 0;
    bool dyadic_ = false; ///< the root is the cell's left end
};

/// All distinct roots of p in [0, 1] in ascending order. In: p is not zero.
std::vector<UnitRoot> unit_roots(const IntegerPolynomial& p);

} // namespace abut
