#pragma once

#include "math/vector.h"

#include <bit>
#include <cstdint>

namespace abut {

/// 2^exponent for exponents of -2000 to 2000. It is stored as two factors, since a single double
/// cannot hold all of these. A product is exact unless it over- or underflows.
class PowerOfTwo {
public:
    explicit PowerOfTwo(int exponent)
        : first_(normal(exponent / 2)), second_(normal(exponent - exponent / 2)) {}

    friend double operator*(const PowerOfTwo& p, double v) { return p.second_ * (p.first_ * v); }
    friend Vec3 operator*(const PowerOfTwo& p, const Vec3& v) { return p.second_ * (p.first_ * v); }

private:
    /// 2^exponent as a normal double.
    static double normal(int exponent) {
        return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
    }

    double first_, second_;
};

} // namespace abut
