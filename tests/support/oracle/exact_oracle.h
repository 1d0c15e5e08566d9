#pragma once

#include "geometry/triangle_triangle_intersect.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Decides whether convex hulls meet, in integers and independently of the library's method. Two
/// hulls meet if and only if the hull of all differences p - q contains the origin. By
/// Caratheodory's theorem, a point of a hull lies in a simplex of at most four of its points.
namespace abut::test {

/// Large enough for differences of doubles within a factor 2^200, and for their determinants.
using BigInt = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    1024, 1024, boost::multiprecision::signed_magnitude, boost::multiprecision::checked, void>>;
/// Large enough for any value.
using AnyInt = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                             boost::multiprecision::et_off>;

template <typename Int>
struct Point {
    Int x, y, z;
};

template <typename Int>
Int dot(const Point<Int>& a, const Point<Int>& b) {
    return Int(a.x * b.x) + Int(a.y * b.y) + Int(a.z * b.z);
}
template <typename Int>
Point<Int> cross(const Point<Int>& a, const Point<Int>& b) {
    return {Int(a.y * b.z) - Int(a.z * b.y), Int(a.z * b.x) - Int(a.x * b.z),
            Int(a.x * b.y) - Int(a.y * b.x)};
}
template <typename Int>
Point<Int> minus(const Point<Int>& a, const Point<Int>& b) {
    return {Int(a.x - b.x), Int(a.y - b.y), Int(a.z - b.z)};
}
template <typename Int>
bool is_zero(const Point<Int>& a) {
    return a.x == 0 && a.y == 0 && a.z == 0;
}
template <typename Int>
int sign_of(const Int& v) {
    return (v > 0) - (v < 0);
}

/// All points in units of one power of two; signs do not depend on the unit. For Int = long long,
/// coordinates must already be integers.
template <typename Int>
std::vector<Point<Int>> as_integers(std::span<const Vec3> points) {
    std::vector<Point<Int>> result;
    if constexpr (std::is_same_v<Int, long long>) {
        for (const Vec3& p : points)
            result.push_back({static_cast<long long>(p.x), static_cast<long long>(p.y),
                              static_cast<long long>(p.z)});
    } else {
        int least = std::numeric_limits<int>::max();
        const auto split = [](double v, int& exponent) {
            const double fraction = std::frexp(v, &exponent);
            auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
            exponent -= 53;
            while (mantissa != 0 && mantissa % 2 == 0)
                mantissa /= 2, ++exponent;
            return mantissa;
        };
        for (const Vec3& p : points)
            for (int axis = 0; axis < 3; ++axis) {
                int exponent = 0;
                if (split(component(p, axis), exponent) != 0)
                    least = std::min(least, exponent);
            }
        const auto integer = [&](double v) {
            int exponent = 0;
            const std::int64_t mantissa = split(v, exponent);
            if (mantissa == 0)
                return Int(0);
            const Int magnitude = Int(mantissa < 0 ? -mantissa : mantissa) << (exponent - least);
            return mantissa < 0 ? Int(-magnitude) : magnitude;
        };
        for (const Vec3& p : points)
            result.push_back({integer(p.x), integer(p.y), integer(p.z)});
    }
    return result;
}

/// The points a_i - b_j, and the determinants of all triples of them.
template <typename Int>
class Differences {
public:
    Differences(std::span<const Vec3> a, std::span<const Vec3> b) {
        std::vector<Vec3> all(a.begin(), a.end());
        all.insert(all.end(), b.begin(), b.end());
        const auto points = as_integers<Int>(all);
        for (std::size_t i = 0; i < a.size(); ++i)
            for (std::size_t j = 0; j < b.size(); ++j)
                p_[n_++] = minus(points[i], points[a.size() + j]);
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = i + 1; j < n_; ++j) {
                const auto normal = cross(p_[i], p_[j]);
                for (std::size_t k = j + 1; k < n_; ++k)
                    set(i, j, k, sign_of(dot(normal, p_[k])));
            }
    }

    /// Whether the hull contains the origin.
    [[nodiscard]] bool hold_origin() const {
        for (std::size_t i = 0; i < n_; ++i) {
            if (is_zero(p_[i]))
                return true;
            for (std::size_t j = i + 1; j < n_; ++j) {
                if (in_segment(p_[i], p_[j]))
                    return true;
                for (std::size_t k = j + 1; k < n_; ++k) {
                    if (det(i, j, k) == 0 && in_triangle(p_[i], p_[j], p_[k]))
                        return true;
                    for (std::size_t l = k + 1; l < n_; ++l)
                        if (in_tetrahedron(i, j, k, l))
                            return true;
                }
            }
        }
        return false;
    }

    /// Whether every plane through the origin has points strictly on both sides. In: the points
    /// span space. It is sufficient to try the planes through two points, whose normals include the
    /// extreme rays of the cone of all normals.
    [[nodiscard]] bool surround_origin() const {
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = i + 1; j < n_; ++j) {
                if (is_zero(cross(p_[i], p_[j])))
                    continue;
                bool above = false, below = false;
                for (std::size_t k = 0; k < n_; ++k) {
                    const int side = k == i || k == j ? 0 : det(i, j, k);
                    above = above || side > 0;
                    below = below || side < 0;
                }
                if (!above || !below)
                    return false;
            }
        return true;
    }

private:
    static bool in_segment(const Point<Int>& p, const Point<Int>& q) {
        return is_zero(cross(p, q)) && dot(p, q) <= 0;
    }
    static bool in_triangle(const Point<Int>& p, const Point<Int>& q, const Point<Int>& r) {
        const auto qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
        const Point<Int> n{Int(qr.x + rp.x + pq.x), Int(qr.y + rp.y + pq.y),
                           Int(qr.z + rp.z + pq.z)};
        return !is_zero(n) && dot(n, qr) >= 0 && dot(n, rp) >= 0 && dot(n, pq) >= 0;
    }
    [[nodiscard]] bool in_tetrahedron(std::size_t i, std::size_t j, std::size_t k,
                                      std::size_t l) const {
        // Barycentric coordinates of the origin, up to a common factor.
        const std::array<int, 4> w{det(j, k, l), -det(i, k, l), det(i, j, l), -det(i, j, k)};
        const auto [low, high] = std::minmax_element(w.begin(), w.end());
        // All are zero if the four points and the origin are coplanar. Then a triangle decides.
        return (*low >= 0 && *high > 0) || (*high <= 0 && *low < 0);
    }

    [[nodiscard]] int det(std::size_t i, std::size_t j, std::size_t k) const {
        return det_[(i * 9 + j) * 9 + k];
    }
    void set(std::size_t i, std::size_t j, std::size_t k, int s) {
        const auto sign = static_cast<signed char>(s), minus = static_cast<signed char>(-s);
        det_[(i * 9 + j) * 9 + k] = det_[(j * 9 + k) * 9 + i] = det_[(k * 9 + i) * 9 + j] = sign;
        det_[(i * 9 + k) * 9 + j] = det_[(k * 9 + j) * 9 + i] = det_[(j * 9 + i) * 9 + k] = minus;
    }

    std::array<Point<Int>, 9> p_{};
    std::size_t n_ = 0;
    std::array<signed char, 729> det_{};
};

template <typename Int>
bool oracle_meet(std::span<const Vec3> a, std::span<const Vec3> b) {
    return Differences<Int>(a, b).hold_origin();
}

template <typename Int>
Point<Int> oracle_normal(const Triangle& t) {
    const auto p = as_integers<Int>(t);
    return cross(minus(p[1], p[0]), minus(p[2], p[0]));
}

/// `cross` by its definition: both triangles have an area, their planes are not parallel, and their
/// relative interiors share a point. The last means that the origin is interior to the differences.
template <typename Int>
TriangleContact oracle_contact(const Triangle& a, const Triangle& b) {
    const Differences<Int> d(a, b);
    if (!d.hold_origin())
        return TriangleContact::none;
    // Normals count as parallel also if one is zero. Each normal has its own unit, which does not
    // matter.
    const bool parallel = is_zero(cross(oracle_normal<Int>(a), oracle_normal<Int>(b)));
    return !parallel && d.surround_origin() ? TriangleContact::cross : TriangleContact::touch;
}

} // namespace abut::test
