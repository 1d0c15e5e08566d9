#include "pieces/relative_motion.h"

#include "math/transform.h"

#include <cmath>

namespace abut {

namespace {

/// Far above relative rounding.
constexpr double kSlack = 0x1p-40;
/// Tolerance for the products of a rotation's columns.
constexpr double kRounding = 0x1p-44;

Vec3 column(const Transform& t, std::size_t k) {
    return {t.m[3 * k], t.m[3 * k + 1], t.m[3 * k + 2]};
}

bool is_rotation(const Transform& t) {
    const Vec3 x = column(t, 0), y = column(t, 1), z = column(t, 2);
    const auto is_one = [](double v) { return std::abs(v - 1) <= kRounding; };
    const auto is_zero = [](double v) { return std::abs(v) <= kRounding; };
    return is_one(length_sq(x)) && is_one(length_sq(y)) && is_one(length_sq(z)) &&
           is_zero(dot(x, y)) && is_zero(dot(y, z)) && is_zero(dot(z, x));
}

/// Bounds the path length of a point of the ball: that of its centre, and that of the turn.
double way(const Transform& from, const Transform& to, const BodyBall& ball, bool rotations) {
    Transform change;
    for (std::size_t i = 0; i < 12; ++i)
        change.m[i] = to.m[i] - from.m[i];
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k)
        square += length_sq(column(change, k));
    // The difference of two rotations stretches all vectors perpendicular to an axis by the same
    // factor: its norm is its Frobenius norm over the root of 2.
    const double turn = std::sqrt(rotations ? 0.5 * square : square);
    return length(apply(change, ball.middle)) + turn * ball.radius;
}

/// The pose of b relative to a, whose pose is a rotation.
Transform seen_from(const Transform& a, const Transform& b) {
    const auto turned_back = [&](const Vec3& v) { return pull_back(a, v); };
    Transform result;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 v = k < 3 ? column(b, k) : column(b, 3) - column(a, 3);
        const Vec3 r = turned_back(v);
        result.m[3 * k] = r.x, result.m[3 * k + 1] = r.y, result.m[3 * k + 2] = r.z;
    }
    return result;
}

double size_of(const Transform& t, const BodyBall& ball) {
    return sum_of_sizes(column(t, 3)) + sum_of_sizes(t) * (sum_of_sizes(ball.middle) + ball.radius);
}

} // namespace

PosePair::PosePair(const Transform& of_a, const Transform& of_b)
    : a(of_a), b(of_b), a_is_rigid(is_rotation(of_a)), b_is_rigid(is_rotation(of_b)) {}

double most_approach(const PosePair& from, const PosePair& to, const BodyBall& a,
                     const BodyBall& b) {
    const bool rotations = to.b_is_rigid && from.b_is_rigid;
    if (from.a == to.a) {
        if (from.b == to.b)
            return 0;
        // A transform that is a rotation only to rounding may stretch the ball by that rounding.
        return way(from.b, to.b, b, rotations) * (1 + kSlack) + 0x1p-50 * size_of(to.b, b) +
               (rotations ? 8 * kRounding * b.radius : 0);
    }
    if (rotations && to.a_is_rigid && from.a_is_rigid) {
        const Transform before = seen_from(from.a, from.b), now = seen_from(to.a, to.b);
        return way(before, now, b, true) * (1 + kSlack) +
               0x1p-40 * (size_of(now, b) + size_of(before, b) + a.radius + sum_of_sizes(a.middle));
    }
    return (way(from.a, to.a, a, false) + way(from.b, to.b, b, false)) * (1 + kSlack) +
           0x1p-50 * (size_of(to.a, a) + size_of(to.b, b));
}

} // namespace abut
