#pragma once

#include <abut/motion.h>

#include "math/transform.h"

namespace abut {

/// A motion, prepared for evaluation at many times. The only implementation of its formula.
class Trajectory {
public:
    /// Errors      Error{bad_argument} if a value is not finite or the quaternion has zero length.
    explicit Trajectory(const Motion& motion);
    /// A motion whose start may be any transform.
    Trajectory(const Transform& start, const Vec3& centre, const Vec3& velocity,
               const Vec3& angular_velocity);
    /// A body at rest.
    explicit Trajectory(const Transform& place) : Trajectory(place, {}, {}, {}) {}

    [[nodiscard]] Transform at(double t) const;
    /// Position of the centre at time t.
    [[nodiscard]] Vec3 centre(double t) const { return centre_ + t * velocity_; }
    [[nodiscard]] const Vec3& velocity() const { return velocity_; }
    [[nodiscard]] const Vec3& angular_velocity() const { return angular_velocity_; }
    [[nodiscard]] double speed_of_rotation() const { return rate_; }
    /// Velocity of the point of the body that is at x at time t.
    [[nodiscard]] Vec3 velocity_at(const Vec3& x, double t) const {
        return velocity_ + cross(angular_velocity_, x - centre(t));
    }
    /// Distance of a world point from the axis through the centre at time t. It is constant for a
    /// point of the body.
    [[nodiscard]] double axis_distance(const Vec3& x, double t) const {
        return length(cross(axis_, x - centre(t)));
    }
    [[nodiscard]] const Transform& start() const { return start_; }

private:
    Transform start_;
    Vec3 centre_, velocity_, angular_velocity_;
    double rate_; ///< |angular_velocity|
    Vec3 axis_;   ///< unit vector, or zero
};

} // namespace abut
