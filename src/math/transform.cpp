#include "math/transform.h"

#include <abut/error.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

namespace abut {

Transform::Transform(const Pose& pose) {
    double w = pose.rotation[0], x = pose.rotation[1], y = pose.rotation[2], z = pose.rotation[3];
    // Divides by the largest component first, so that no square of a valid quaternion over- or
    // underflows.
    const double largest = std::max({std::abs(w), std::abs(x), std::abs(y), std::abs(z)});
    // Zero times infinity or NaN is NaN, which makes the comparison false.
    const Vec3& at = pose.translation;
    if (!(0 * w + 0 * x + 0 * y + 0 * z + 0 * at.x + 0 * at.y + 0 * at.z == 0))
        throw Error(ErrorCode::bad_argument, "pose has a value that is not finite");
    if (largest == 0)
        throw Error(ErrorCode::bad_argument, "pose has a quaternion of zero length");
    w /= largest, x /= largest, y /= largest, z /= largest;
    const double s = 2 / (w * w + x * x + y * y + z * z);
    m = {1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w), s * (x * y - z * w),
         1 - s * (x * x + z * z), s * (y * z + x * w), s * (x * z + y * w), s * (y * z - x * w),
         1 - s * (x * x + y * y), pose.translation.x,  pose.translation.y,  pose.translation.z};
}

Transform compose(const Transform& a, const Transform& b) {
    Transform r;
    for (std::size_t c = 0; c < 4; ++c) {
        const Vec3 column{b.m[3 * c], b.m[3 * c + 1], b.m[3 * c + 2]};
        const Vec3 v = c < 3 ? apply_linear(a, column) : apply(a, column);
        r.m[3 * c] = v.x, r.m[3 * c + 1] = v.y, r.m[3 * c + 2] = v.z;
    }
    return r;
}

Transform inverse(const Transform& t) {
    const auto& m = t.m;
    const Vec3 c0{m[0], m[1], m[2]}, c1{m[3], m[4], m[5]}, c2{m[6], m[7], m[8]};
    // The rows of the inverse are cross products of the columns, divided by the determinant.
    const Vec3 r0 = cross(c1, c2), r1 = cross(c2, c0), r2 = cross(c0, c1);
    const double s = 1 / dot(c0, r0);
    Transform r({s * r0.x, s * r1.x, s * r2.x, s * r0.y, s * r1.y, s * r2.y, s * r0.z, s * r1.z,
                 s * r2.z, 0, 0, 0});
    const Vec3 origin = apply_linear(r, {m[9], m[10], m[11]});
    r.m[9] = -origin.x, r.m[10] = -origin.y, r.m[11] = -origin.z;
    return r;
}

Stretch stretch_of(const Transform& t) {
    const auto& m = t.m;
    const std::array<Vec3, 3> c{Vec3{m[0], m[1], m[2]}, Vec3{m[3], m[4], m[5]},
                                Vec3{m[6], m[7], m[8]}};
    const double xx = length_sq(c[0]), yy = length_sq(c[1]), zz = length_sq(c[2]);
    const double xy = dot(c[0], c[1]), yz = dot(c[1], c[2]), zx = dot(c[2], c[0]);
    // By Gershgorin's theorem, every eigenvalue of L^T L lies in a disc around a diagonal entry.
    const double rx = std::abs(xy) + std::abs(zx), ry = std::abs(xy) + std::abs(yz),
                 rz = std::abs(yz) + std::abs(zx);
    double least = std::min({xx - rx, yy - ry, zz - rz}),
           most = std::max({xx + rx, yy + ry, zz + rz});
    if (least < (1 - 1e-5) * most) {
        Eigen::Matrix3d gram;
        gram << xx, xy, zx, xy, yy, yz, zx, yz, zz;
        const Eigen::Vector3d values =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(gram, Eigen::EigenvaluesOnly)
                .eigenvalues();
        most = std::min(most, values[2]);
        least = values[0] - 1e-14 * most; // the solver's error is a few roundings of the largest
                                          // eigenvalue
    }
    constexpr double kRounding = 1e-14;
    return {least > 0 ? std::sqrt(least) * (1 - kRounding) : 0, std::sqrt(most) * (1 + kRounding)};
}

void require_finite(const Transform& t, const char* what) {
    if (!std::all_of(t.m.begin(), t.m.end(), [](double v) { return std::isfinite(v); }))
        throw Error(ErrorCode::bad_argument, std::string(what) + " has a value that is not finite");
}

} // namespace abut
