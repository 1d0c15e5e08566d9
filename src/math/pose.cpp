#include <abut/pose.h>

#include "math/transform.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

using Quaternion = std::array<double, 4>;

/// Scales a quaternion to unit length. It is divided by its largest component first, so that no square
/// overflows or vanishes.
Quaternion unit(Quaternion q) {
    const double largest =
        std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
    double length_sq = 0;
    for (double& value : q) {
        value /= largest;
        length_sq += value * value;
    }
    for (double& value : q)
        value /= std::sqrt(length_sq);
    return q;
}

/// The rotation q followed by the rotation p.
Quaternion product(const Quaternion& p, const Quaternion& q) {
    return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

} // namespace

Pose operator*(const Pose& a, const Pose& b) {
    const Transform first(b), second(a); // refuse what is no pose
    return {apply(second, b.translation), unit(product(unit(a.rotation), unit(b.rotation)))};
}

Pose inverse(const Pose& pose) {
    const Vec3 back = -1 * pull_back(Transform(pose), pose.translation);
    const Quaternion q = unit(pose.rotation);
    return {back, {q[0], -q[1], -q[2], -q[3]}};
}

Vec3 apply(const Pose& pose, const Vec3& point) {
    return apply(Transform(pose), point);
}

Vec3 rotate(const Pose& pose, const Vec3& direction) {
    return apply_linear(Transform(pose), direction);
}

} // namespace abut
