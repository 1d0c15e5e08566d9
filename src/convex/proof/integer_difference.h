#pragma once

#include "convex/proof/placed_points.h"
#include "math/scaled_integers.h"
#include "math/vector.h"

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

/// The difference b - a of two point sets, in integers times one power of two, without rounding.
namespace abut {

using Int512 = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    512, 512, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
using IntAny = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                             boost::multiprecision::et_off>;

/// A value as a double times a power of two, which may be beyond the range of doubles.
struct ScaledDouble {
    double mantissa = 0; ///< 0, or of magnitude in [1/2, 1)
    int exponent = 0;
};

/// Accuracy    within 2^-52 of the value.
template <class Int>
ScaledDouble scaled_double(const Int& value) {
    if (value == 0)
        return {};
    const bool negative = value < 0;
    Int size = negative ? Int(-value) : value;
    int shift = 0;
    if constexpr (std::is_same_v<Int, __int128>)
        while (size >> 62 != 0)
            size >>= 16, shift += 16;
    else if (const int bits = static_cast<int>(msb(size)); bits >= 62)
        shift = bits - 61, size >>= shift;
    int exponent = 0;
    const double mantissa =
        std::frexp(static_cast<double>(static_cast<std::int64_t>(size)), &exponent);
    return {negative ? -mantissa : mantissa, exponent + shift};
}

template <class Int>
int sign_of(const Int& v) {
    return (v > 0) - (v < 0);
}

template <class Int>
struct IntVec3 {
    Int x{}, y{}, z{};
    friend IntVec3 operator-(const IntVec3& a, const IntVec3& b) {
        return {Int(a.x - b.x), Int(a.y - b.y), Int(a.z - b.z)};
    }
    friend IntVec3 operator-(const IntVec3& a) { return {Int(-a.x), Int(-a.y), Int(-a.z)}; }
    friend bool operator==(const IntVec3& a, const IntVec3& b) {
        return a.x == b.x && a.y == b.y && a.z == b.z;
    }
};
template <class Int>
Int dot(const IntVec3<Int>& a, const IntVec3<Int>& b) {
    return Int(a.x * b.x + a.y * b.y + a.z * b.z);
}
template <class Int>
IntVec3<Int> cross(const IntVec3<Int>& a, const IntVec3<Int>& b) {
    return {Int(a.y * b.z - a.z * b.y), Int(a.z * b.x - a.x * b.z), Int(a.x * b.y - a.y * b.x)};
}
template <class Int>
IntVec3<Int> scaled(const Int& s, const IntVec3<Int>& a) {
    return {Int(s * a.x), Int(s * a.y), Int(s * a.z)};
}
template <class Int>
bool is_zero(const IntVec3<Int>& a) {
    return a.x == 0 && a.y == 0 && a.z == 0;
}

/// The vector in doubles, scaled by some power of two so that it neither over- nor underflows.
///
/// Accuracy    each coordinate is within 2^-51 of the largest magnitude.
template <class Int>
Vec3 direction_of(const IntVec3<Int>& v) {
    const ScaledDouble x = scaled_double(v.x), y = scaled_double(v.y), z = scaled_double(v.z);
    const auto top = [](const ScaledDouble& s) {
        return s.mantissa == 0 ? std::numeric_limits<int>::min() : s.exponent;
    };
    const int most = std::max({top(x), top(y), top(z)});
    const auto value = [&](const ScaledDouble& s) {
        return s.mantissa == 0 ? 0 : std::ldexp(s.mantissa, std::max(s.exponent - most, -1000));
    };
    return {value(x), value(y), value(z)};
}

/// The bits that hold all coordinates of the points as integers, and the exponent of their unit.
struct IntegerGrid {
    explicit IntegerGrid(const PlacedPoints& points) {
        int largest = std::numeric_limits<int>::min();
        least = std::numeric_limits<int>::max();
        const auto add = [&](double v) {
            const Binary binary = decompose(v);
            if (binary.mantissa == 0)
                return;
            const auto size = static_cast<std::uint64_t>(std::abs(binary.mantissa));
            least = std::min(least, binary.exponent);
            largest = std::max(largest, binary.exponent + static_cast<int>(std::bit_width(size)));
        };
        for (const auto* side : {&points.a, &points.b})
            for (const Vec3& p : *side)
                add(p.x), add(p.y), add(p.z);
        if (largest < least)
            least = largest = 0;
        bits = largest - least;
    }
    int least = 0, bits = 0;
};

/// The largest IntegerGrid::bits for which products of four coordinate differences, and sums of
/// some dozen such products, fit in the type.
inline constexpr int kBitsOf128 = 28, kBitsOf512 = 124;

/// Corners of the difference, named by numbers of points; finds the farthest one along a direction.
template <class Int>
class IntegerDifference {
public:
    using Vector = IntVec3<Int>;

    IntegerDifference(const PlacedPoints& points, const IntegerGrid& grid)
        : points_(&points), least_(grid.least) {
        reference_ = points.a[0];
    }

    [[nodiscard]] Vector at(const VertexPair& corner) const {
        return integer(points_->b[corner.b]) - integer(points_->a[corner.a]);
    }
    [[nodiscard]] int exponent() const { return least_; }

    /// The corner that is farthest along a direction, exactly.
    [[nodiscard]] VertexPair farthest(const Vector& direction) const {
        const Vec3 d = direction_of(direction);
        return {farthest(points_->a, -direction, -d), farthest(points_->b, direction, d)};
    }

private:
    [[nodiscard]] Int integer(double value) const {
        const Binary binary = decompose(value);
        if (binary.mantissa == 0)
            return Int(0);
        const Int size = Int(std::abs(binary.mantissa)) << (binary.exponent - least_);
        return binary.mantissa < 0 ? Int(-size) : size;
    }

    [[nodiscard]] Vector integer(const Vec3& p) const {
        return {integer(p.x), integer(p.y), integer(p.z)};
    }

    /// Doubles select a few candidates; integers decide among them.
    [[nodiscard]] std::uint32_t farthest(const std::vector<Vec3>& points, const Vector& direction,
                                         const Vec3& d) const {
        double most = -std::numeric_limits<double>::infinity(), extent = 0;
        heights_.resize(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3 p = points[i] - reference_;
            heights_[i] = dot(d, p);
            most = std::max(most, heights_[i]);
            extent = std::max(extent, max_abs(p));
        }
        // Each product loses a few roundings of a coordinate; the direction's coordinates are at
        // most 1.
        const double error = 0x1p-47 * extent + 64 * std::numeric_limits<double>::denorm_min();
        std::uint32_t best = 0;
        bool found = false;
        Int best_height{};
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            // Also a candidate if its height is not a number: differences of coordinates may
            // overflow.
            if (heights_[i] < most - error)
                continue;
            Int height = dot(direction, integer(points[i]));
            if (!found || height > best_height)
                best = i, best_height = std::move(height), found = true;
        }
        return best;
    }

    const PlacedPoints* points_;
    int least_;
    Vec3 reference_;
    mutable std::vector<double> heights_;
};

/// Calls f.template operator()<Int>() with an integer type that is wide enough.
template <class F>
auto with_integers(const IntegerGrid& grid, const F& f) {
    if (grid.bits <= kBitsOf128)
        return f.template operator()<__int128>();
    if (grid.bits <= kBitsOf512)
        return f.template operator()<Int512>();
    return f.template operator()<IntAny>();
}

} // namespace abut
