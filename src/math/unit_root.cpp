#include "math/unit_root.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace abut {

namespace {

/// Cells of size 2^-kFirstLevel decide most signs that are not zero.
constexpr unsigned kFirstLevel = 40;

/// 2^degree p(u / 2): the polynomial in the left half of a cell.
IntegerPolynomial left_half(IntegerPolynomial p) {
    const int degree = p.degree();
    for (int i = 0; i < degree; ++i)
        p.c[static_cast<std::size_t>(i)] <<= static_cast<unsigned>(degree - i);
    return p;
}

/// p(u + 1)
IntegerPolynomial shifted_by_one(IntegerPolynomial p) {
    for (std::size_t first = 0; first < 3; ++first)
        for (std::size_t i = 3; i-- > first;)
            p.c[i] += p.c[i + 1];
    return p;
}

/// An approximate zero of p. In: p has one zero in (0, 1) and changes its sign there.
double zero_of(const IntegerPolynomial& p) {
    const auto c = common_scale(p.c);
    double low = 0, high = 1;
    for (int i = 0; i < 48; ++i) {
        const double u = 0.5 * (low + high);
        const double value = c[0] + u * (c[1] + u * (c[2] + u * c[3]));
        ((value < 0) == (c[0] < 0) ? low : high) = u;
    }
    return 0.5 * (low + high);
}

/// p / u. In: p(0) = 0.
IntegerPolynomial without_root_at_zero(const IntegerPolynomial& p) {
    return {{p.c[1], p.c[2], p.c[3], BigInt(0)}};
}

struct Isolation {
    const IntegerPolynomial& square_free;
    std::vector<UnitRoot>& roots;

    /// Finds the roots in the half-open cell [index, index + 1) / 2^level.
    void in_cell(IntegerPolynomial local, const BigInt& index, unsigned level) const {
        if (local.c[0].is_zero()) {
            roots.emplace_back(index, level);
            local = without_root_at_zero(local);
        }
        const int variations = sign_variations(local);
        if (variations == 1)
            roots.emplace_back(square_free, local, index, level);
        if (variations > 1) {
            const IntegerPolynomial left = left_half(local);
            in_cell(left, 2 * index, level + 1);
            in_cell(shifted_by_one(left), 2 * index + 1, level + 1);
        }
    }
};

} // namespace

UnitRoot::UnitRoot(BigInt index, unsigned level)
    : index_(std::move(index)), level_(level), dyadic_(true) {}

UnitRoot::UnitRoot(IntegerPolynomial square_free, IntegerPolynomial local, BigInt index,
                   unsigned level)
    : square_free_(std::move(square_free)), local_(std::move(local)), index_(std::move(index)),
      level_(level) {}

void UnitRoot::halve() {
    ++level_;
    index_ <<= 1;
    if (dyadic_)
        return;
    local_ = left_half(std::move(local_));
    const int middle = local_.sign_at_one();
    if (middle != 0 && middle != local_.c[0].sign())
        return;
    ++index_;
    if (middle == 0)
        dyadic_ = true;
    else
        local_ = shifted_by_one(std::move(local_));
}

bool UnitRoot::jump(unsigned halvings) {
    const BigInt cell(
        static_cast<std::uint64_t>(std::ldexp(zero_of(local_), static_cast<int>(halvings))));
    IntegerPolynomial local = restricted(local_, cell, halvings);
    const int left = local.c[0].sign();
    if (left * local.sign_at_one() > 0 || local.sign_at_one() == 0)
        return false;
    dyadic_ = left == 0;
    local_ = std::move(local);
    index_ = (index_ << halvings) + cell;
    level_ += halvings;
    return true;
}

void UnitRoot::refine(unsigned level) {
    constexpr unsigned kLongest = 40, kShortest = 5;
    unsigned longest = kLongest;
    while (level_ < level) {
        const unsigned halvings = std::min(level - level_, longest);
        if (dyadic_ || halvings < kShortest)
            halve();
        else if (!jump(halvings))
            longest = halvings / 2;
    }
}

int UnitRoot::sign_of(const IntegerPolynomial& p) {
    if (p.degree() < 1)
        return p.c[0].sign();
    refine(kFirstLevel);
    for (bool may_be_zero = true;; may_be_zero = false) {
        const IntegerPolynomial here = restricted(p, index_, level_);
        if (dyadic_)
            return here.c[0].sign();
        if (const int sign = certain_sign(here); sign != 0)
            return sign;
        if (may_be_zero) {
            // Roots of the common divisor are roots of the square-free polynomial, so at most one
            // lies in this cell.
            const IntegerPolynomial common = common_divisor(square_free_, p);
            if (sign_variations(restricted(common, index_, level_)) % 2 == 1)
                return 0;
        }
        refine(2 * level_);
    }
}

double UnitRoot::lower_bound() const {
    constexpr unsigned kBits = 53;
    if (level_ <= kBits)
        return std::ldexp(static_cast<double>(static_cast<std::uint64_t>(index_)),
                          -static_cast<int>(level_));
    const BigInt rounded = index_ >> (level_ - kBits);
    return std::ldexp(static_cast<double>(static_cast<std::uint64_t>(rounded)),
                      -static_cast<int>(kBits));
}

BigInt UnitRoot::value_at_left(const IntegerPolynomial& p, int degree) const {
    const BigInt value = restricted(p, index_, level_).c[0];
    return value << level_ * static_cast<unsigned>(degree - std::max(p.degree(), 0));
}

std::vector<UnitRoot> unit_roots(const IntegerPolynomial& p) {
    std::vector<UnitRoot> roots;
    if (p.degree() < 1)
        return roots;
    const IntegerPolynomial repeated = common_divisor(p, derivative(p));
    const IntegerPolynomial square_free = repeated.degree() > 0 ? quotient(p, repeated) : p;
    Isolation{square_free, roots}.in_cell(square_free, BigInt(0), 0);
    if (square_free.sign_at_one() == 0)
        roots.emplace_back(BigInt(1), 0);
    return roots;
}

} // namespace abut
