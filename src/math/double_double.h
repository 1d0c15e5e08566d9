#pragma once

#include "math/vector.h"

namespace abut {

/// The unevaluated sum of two doubles, the second at most half a unit in the last place of the first.
/// Sums and products of doubles have 106 bits.
///
/// Accuracy    one operation has a relative error of at most 2^-100; a difference that cancels, one
///             of 2^-100 of its terms. Operands must neither overflow nor underflow when squared.
/// Source      [Dekker 1971].
struct DoubleDouble {
    double high = 0, low = 0;

    DoubleDouble() = default;
    DoubleDouble(double value) : high(value) {} // NOLINT(google-explicit-constructor): a number
    DoubleDouble(double big, double small) : high(big + small), low(small - (high - big)) {}

    static DoubleDouble sum(double a, double b) {
        DoubleDouble result;
        result.high = a + b;
        const double of_b = result.high - a;
        result.low = (a - (result.high - of_b)) + (b - of_b);
        return result;
    }
    static DoubleDouble product(double a, double b) {
        const auto [a1, a2] = halves(a);
        const auto [b1, b2] = halves(b);
        DoubleDouble result;
        result.high = a * b;
        result.low = ((a1 * b1 - result.high) + a1 * b2 + a2 * b1) + a2 * b2;
        return result;
    }

private:
    struct Halves {
        double high, low;
    };
    /// Two numbers of at most 26 bits with this sum.
    static Halves halves(double a) {
        constexpr double kSplit = 0x1p27 + 1;
        const double scaled = kSplit * a, high = scaled - (scaled - a);
        return {high, a - high};
    }
};

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = DoubleDouble::sum(a.high, b.high),
                       low = DoubleDouble::sum(a.low, b.low);
    const DoubleDouble first(high.high, high.low + low.high);
    return {first.high, first.low + low.low};
}
inline DoubleDouble operator-(const DoubleDouble& a) {
    return {-a.high, -a.low};
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
    return a + -b;
}
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble main = DoubleDouble::product(a.high, b.high);
    return {main.high, main.low + (a.high * b.low + a.low * b.high)};
}
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high / b.high;
    const DoubleDouble rest = a - b * DoubleDouble(first);
    const double second = rest.high / b.high;
    const DoubleDouble last = rest - b * DoubleDouble(second);
    return DoubleDouble(first, second) + DoubleDouble(last.high / b.high);
}

inline bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
}

/// A vector of such numbers.
struct WideVec3 {
    DoubleDouble x, y, z;

    WideVec3() = default;
    explicit WideVec3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
    WideVec3(const DoubleDouble& at_x, const DoubleDouble& at_y, const DoubleDouble& at_z)
        : x(at_x), y(at_y), z(at_z) {}
    [[nodiscard]] Vec3 rounded() const { return {x.high, y.high, z.high}; }
};

inline WideVec3 operator+(const WideVec3& a, const WideVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline WideVec3 operator-(const WideVec3& a, const WideVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline WideVec3 operator*(const DoubleDouble& s, const WideVec3& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline DoubleDouble dot(const WideVec3& a, const WideVec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline WideVec3 cross(const WideVec3& a, const WideVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

} // namespace abut
