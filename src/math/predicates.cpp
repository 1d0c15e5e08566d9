#include "math/predicates.h"

#include "math/scaled_integers.h"
#include "math/vector.h"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>

namespace abut {

namespace {

thread_local std::uint64_t t_exact_signs = 0;

constexpr double kEpsilon = 0x1p-53;
// Far above the loss of a product of two differences to underflow, before it is scaled by the third.
// It is a normal number: a product with a subnormal one takes a hundred cycles.
constexpr double kUnderflow = 0x1p-1000;

using Int256 = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    256, 256, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
using Int512 = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    512, 512, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
using IntAny = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                             boost::multiprecision::et_off>;

int sign(double v) {
    return (v > 0) - (v < 0);
}

template <typename Int>
int sign_of(const Int& v) {
    return (v > 0) - (v < 0);
}

/// Sign of the determinant of three rows. Int can hold products of two entries, Wide products of
/// three.
template <typename Int, typename Wide>
int determinant_sign(const std::array<Int, 9>& d) {
    const Int x = d[4] * d[8] - d[5] * d[7], y = d[5] * d[6] - d[3] * d[8],
              z = d[3] * d[7] - d[4] * d[6];
    return sign_of(Wide(Wide(d[0]) * Wide(x) + Wide(d[1]) * Wide(y) + Wide(d[2]) * Wide(z)));
}

/// The rows are b - a (or b itself, if it is a direction), c - a, d - a.
template <typename Int, typename Wide>
int orient3d_integer(const Scaled<12>& s, bool direction) {
    std::array<Int, 9> d{};
    for (std::size_t i = 0; i < 9; ++i)
        d[i] = direction && i < 3 ? s.get<Int>(3 + i) : Int(s.get<Int>(3 + i) - s.get<Int>(i % 3));
    return determinant_sign<Int, Wide>(d);
}

template <typename Int>
int orient2d_integer(const Scaled<6>& s) {
    const Int ux = s.get<Int>(2) - s.get<Int>(0), uy = s.get<Int>(3) - s.get<Int>(1);
    const Int vx = s.get<Int>(4) - s.get<Int>(0), vy = s.get<Int>(5) - s.get<Int>(1);
    return sign_of(Int(ux * vy - uy * vx));
}

/// `direction`: b is a direction, not a point.
int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                   bool direction = false) {
    ++t_exact_signs;
    // Faces of buildings lie in planes along the axes: points with a coordinate in common.
    if (!direction &&
        ((a.x == b.x && a.x == c.x && a.x == d.x) || (a.y == b.y && a.y == c.y && a.y == d.y) ||
         (a.z == b.z && a.z == c.z && a.z == d.z)))
        return 0;
    const Scaled<12> s({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z});
    // |difference| < 2^(bits + 1), |x| < 2^(2 bits + 3), |det| < 6 * 2^(3 (bits + 1))
    if (s.bits <= 40)
        return orient3d_integer<__int128, __int128>(s, direction);
    if (s.bits <= 61)
        return orient3d_integer<__int128, Int256>(s, direction);
    return s.bits <= 168 ? orient3d_integer<Int512, Int512>(s, direction)
                         : orient3d_integer<IntAny, IntAny>(s, direction);
}

int orient2d_exact(double ax, double ay, double bx, double by, double cx, double cy) {
    ++t_exact_signs;
    const Scaled<6> s({ax, ay, bx, by, cx, cy});
    if (s.bits <= 61)
        return orient2d_integer<__int128>(s);
    return s.bits <= 252 ? orient2d_integer<Int512>(s) : orient2d_integer<IntAny>(s);
}

int orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
    const double left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax);
    const double det = left - right;
    const double bound =
        (3 + 16 * kEpsilon) * kEpsilon * (std::abs(left) + std::abs(right)) + kUnderflow;
    if (det > bound || -det > bound)
        return sign(det);
    if ((ax == bx && ay == by) || (ax == cx && ay == cy) || (bx == cx && by == cy))
        return 0;
    return orient2d_exact(ax, ay, bx, by, cx, cy);
}

/// Sign of u . (v x w), where each vector is a rounded difference of two points. Returns 0 if
/// rounding may have changed the sign.
int determinant_filter(const Vec3& u, const Vec3& v, const Vec3& w) {
    const double vywz = v.y * w.z, vzwy = v.z * w.y;
    const double vzwx = v.z * w.x, vxwz = v.x * w.z;
    const double vxwy = v.x * w.y, vywx = v.y * w.x;
    const double det = u.x * (vywz - vzwy) + u.y * (vzwx - vxwz) + u.z * (vxwy - vywx);
    const double permanent = std::abs(u.x) * (std::abs(vywz) + std::abs(vzwy)) +
                             std::abs(u.y) * (std::abs(vzwx) + std::abs(vxwz)) +
                             std::abs(u.z) * (std::abs(vxwy) + std::abs(vywx));
    const double bound = (8 + 64 * kEpsilon) * kEpsilon * permanent +
                         kUnderflow * (1 + std::abs(u.x) + std::abs(u.y) + std::abs(u.z));
    // Overflow makes the bound infinite or not a number; then both comparisons are false.
    return det > bound || -det > bound ? sign(det) : 0;
}

} // namespace

std::uint64_t exact_signs() {
    return t_exact_signs;
}

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    if (const int side = determinant_filter(b - a, c - a, d - a); side != 0)
        return side;
    // Frequent cases that are quickly decided: a shared vertex, a collapsed triangle.
    if (b == a || c == a || d == a || c == b || d == b || d == c)
        return 0;
    return orient3d_exact(a, b, c, d);
}

int turn_around_line(const Vec3& origin, const Vec3& direction, const Vec3& p, const Vec3& q) {
    if (const int turn = determinant_filter(direction, p - origin, q - origin); turn != 0)
        return turn;
    if (p == origin || q == origin || p == q)
        return 0;
    return orient3d_exact(origin, direction, p, q, true);
}

int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
    switch (axis) {
    case 0:
        return orient2d(a.y, a.z, b.y, b.z, c.y, c.z);
    case 1:
        return orient2d(a.z, a.x, b.z, b.x, c.z, c.x);
    default:
        return orient2d(a.x, a.y, b.x, b.y, c.x, c.y);
    }
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
    return orient2d(a, b, c, 2) == 0 && orient2d(a, b, c, 0) == 0 && orient2d(a, b, c, 1) == 0;
}

} // namespace abut
