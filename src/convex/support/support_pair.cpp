#include "convex/support/support_pair.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// A power of two that brings a length near 1, as far as it is finite itself.
double factor_of(double size) {
    constexpr int kLargest = 1000;
    return size > 0 ? std::ldexp(1.0, std::min(-std::ilogb(size), kLargest)) : 1;
}

/// A bound of the roundings of a coordinate of the difference: those of two farthest points, and of
/// their difference.
constexpr double kRoundings = 0x1p-49;

} // namespace

DifferencePoint SupportSimplex::nearest() const {
    DifferencePoint sum;
    for (std::uint32_t i = 0; i < count; ++i) {
        sum.at = sum.at + weights[i] * corners[i].at;
        sum.a = sum.a + weights[i] * corners[i].a;
        sum.b = sum.b + weights[i] * corners[i].b;
    }
    return sum;
}

SupportPair::SupportPair(const SupportShape& a, const SupportShape& b)
    : a_(with_largest_radius(a)), b_(with_largest_radius(b)), offset_(b.centre - a.centre) {
    const double size = max_abs(offset_) + a_.reach + b_.reach + a_.radius + b_.radius;
    factor_ = factor_of(size);
    a_ = scaled(a_, factor_), b_ = scaled(b_, factor_);
    offset_ = factor_ * offset_;
    rounding_ = kRoundings * factor_ * size;
}

} // namespace abut
