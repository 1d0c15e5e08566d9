#include "rigid/motion/trajectory.h"

#include <abut/error.h>

#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

using Quaternion = std::array<double, 4>; // w, x, y, z

/// The pose's rotation as a unit quaternion. The pose was checked by its Transform.
Quaternion unit_rotation(const Pose& pose) {
    Quaternion q = pose.rotation;
    const double largest =
        std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
    double sum = 0;
    for (double& v : q)
        v /= largest, sum += v * v;
    for (double& v : q)
        v /= std::sqrt(sum);
    return q;
}

/// The rotation from start to end along the shortest arc: axis times angle, in [0, pi].
Vec3 rotation_between(const Pose& start, const Pose& end) {
    const Quaternion p = unit_rotation(start), q = unit_rotation(end);
    const Vec3 u{p[1], p[2], p[3]}, v{q[1], q[2], q[3]};
    // q times the conjugate of p
    double w = q[0] * p[0] + dot(u, v);
    Vec3 xyz = p[0] * v - q[0] * u - cross(v, u);
    if (w < 0)
        w = -w, xyz = -xyz;
    const double sine = length(xyz);
    return sine > 0 ? (2 * std::atan2(sine, w) / sine) * xyz : Vec3{};
}

void require_finite_vector(const Vec3& v, const char* what) {
    if (!is_finite(v))
        throw Error(ErrorCode::bad_argument,
                    std::string("motion: ") + what + " has a value that is not finite");
}

} // namespace

Trajectory::Trajectory(const Motion& motion)
    : Trajectory(Transform(motion.start), motion.centre, motion.velocity, motion.angular_velocity) {
}

Trajectory::Trajectory(const Transform& start, const Vec3& centre, const Vec3& velocity,
                       const Vec3& angular_velocity)
    : start_(start), centre_(centre), velocity_(velocity), angular_velocity_(angular_velocity) {
    require_finite(start_, "motion: start");
    require_finite_vector(centre_, "centre");
    require_finite_vector(velocity_, "velocity");
    require_finite_vector(angular_velocity_, "angular velocity");
    rate_ = std::hypot(angular_velocity_.x, angular_velocity_.y, angular_velocity_.z);
    axis_ = rate_ > 0 ? Vec3{angular_velocity_.x / rate_, angular_velocity_.y / rate_,
                             angular_velocity_.z / rate_}
                      : Vec3{};
}

Transform Trajectory::at(double t) const {
    Transform pose = start_;
    const Vec3 origin{start_.m[9], start_.m[10], start_.m[11]};
    Vec3 moved = origin + t * velocity_;
    if (rate_ > 0) {
        // (Rot - I) x = sin(angle) n x x + (1 - cos(angle)) n x (n x x). The factor 1 - cos(angle)
        // is computed as 2 sin^2(angle / 2), so that slow rotations about far centres lose no
        // digits.
        const double angle = t * rate_;
        const double sine = std::sin(angle), half_sine = std::sin(0.5 * angle);
        const double versine = 2 * half_sine * half_sine;
        const auto turned = [&](const Vec3& x) {
            const Vec3 nx = cross(axis_, x);
            return sine * nx + versine * cross(axis_, nx);
        };
        for (std::size_t column = 0; column < 9; column += 3) {
            const Vec3 x{start_.m[column], start_.m[column + 1], start_.m[column + 2]};
            const Vec3 y = x + turned(x);
            pose.m[column] = y.x, pose.m[column + 1] = y.y, pose.m[column + 2] = y.z;
        }
        moved = moved + turned(origin - centre_);
    }
    pose.m[9] = moved.x, pose.m[10] = moved.y, pose.m[11] = moved.z;
    return pose;
}

Motion Motion::fixed(const Pose& pose) {
    return {pose, pose.translation, {}, {}};
}

Motion Motion::between(const Pose& start, const Pose& end, const Vec3& about) {
    const Vec3 from = apply(Transform(start), about), to = apply(Transform(end), about);
    return {start, from, to - from, rotation_between(start, end)};
}

Motion Motion::screw(const Pose& start, const Pose& end) {
    const Motion straight = between(start, end);
    const Vec3 w = straight.angular_velocity;
    const double angle = length(w);
    // From s to s + d: d = h n + (Rot - I)(s - c), with n the axis. Solved for the point c of the
    // axis nearest to s: c = s + (d' + cot(angle / 2) n x d') / 2, with d' the part of d across the
    // axis.
    const Vec3 n = normalized_or_zero(w), d = straight.velocity;
    const Vec3 along = dot(d, n) * n, across = d - along;
    const Vec3 centre =
        straight.centre + 0.5 * across + (0.5 / std::tan(0.5 * angle)) * cross(n, across);
    // If the rotation is so small that its axis lies beyond the range of doubles, the motion is
    // straight.
    return is_finite(centre) && angle > 0 ? Motion{start, centre, along, w} : straight;
}

Transform at(const Motion& motion, double t) {
    if (!std::isfinite(t))
        throw Error(ErrorCode::bad_argument, "time of a motion must be finite");
    return Trajectory(motion).at(t);
}

} // namespace abut
