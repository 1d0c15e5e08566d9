#include "assembly/loops.h"

#include <abut/error.h>

#include "math/transform.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Largest sine of the angle between directions that must be parallel or normal.
constexpr double kPlaneError = 1e-6;

/// The angle about the axis from one direction in the plane to another one.
double angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) {
    const Vec3 a = from - dot(from, axis) * axis;
    const Vec3 b = to - dot(to, axis) * axis;
    return std::atan2(dot(axis, cross(a, b)), dot(a, b));
}

} // namespace

LoopGeometry::LoopGeometry(const Assembly& assembly, const AssemblyLoop& loop,
                           const Vec3& coupler_axis, const Vec3& closer_axis)
    : crank_pin_(assembly.parts[loop.coupler].joint.origin), pin_(loop.pin),
      centre_(assembly.parts[loop.closer].joint.origin), axis_(coupler_axis) {
    slides_ = assembly.parts[loop.closer].joint.type == AssemblyJointType::prismatic;
    if (slides_ && std::abs(dot(closer_axis, axis_)) > kPlaneError)
        throw Error(ErrorCode::bad_argument,
                    "the slider's axis is not normal to the axis of the coupler's joint");
    if (!slides_ && length(cross(closer_axis, axis_)) > kPlaneError)
        throw Error(ErrorCode::bad_argument, "the axes of both joints are not parallel");
    along_ = slides_ ? normalized_or_zero(closer_axis - dot(closer_axis, axis_) * axis_)
                     : perpendicular(axis_);
    across_ = cross(axis_, along_);
    const Plane coupler = in_plane(pin_ - crank_pin_);
    coupler_length_ = std::hypot(coupler.along, coupler.across);
    const Plane closer = in_plane(pin_ - centre_);
    closer_length_ = std::hypot(closer.along, closer.across);
    if (!(coupler_length_ > 0))
        throw Error(ErrorCode::bad_argument, "the pin lies on the axis of the coupler's joint");
    if (!slides_ && !(closer_length_ > 0))
        throw Error(ErrorCode::bad_argument, "the pin lies on the axis of the closer's joint");
    // The side tells on which side of its dead point the loop is at rest.
    const double turn = slides_ ? coupler.along / coupler_length_
                                : (coupler.along * closer.across - coupler.across * closer.along) /
                                      (coupler_length_ * closer_length_);
    if (!(std::abs(turn) >= kLeastTransmission))
        throw Error(ErrorCode::bad_argument,
                    "it is at a dead point at rest, so its side is not known");
    side_ = (turn > 0) == slides_ ? 1 : -1;
    closer_sign_ = dot(closer_axis, axis_) < 0 ? -1 : 1;
}

LoopGeometry::Plane LoopGeometry::in_plane(const Vec3& v) const {
    return {dot(v, along_), dot(v, across_)};
}

LoopState LoopGeometry::solve(const Transform& closer_from_coupler) const {
    // The crank must stay in the plane of the loop: neither tilt nor move along the axis.
    if (length(cross(apply_linear(closer_from_coupler, axis_), axis_)) > kPlaneError)
        return {};
    const Vec3 crank = apply(closer_from_coupler, crank_pin_);
    const Vec3 way_of_crank = crank - crank_pin_;
    if (!(std::abs(dot(way_of_crank, axis_)) <=
          kPlaneError * (length(way_of_crank) + coupler_length_)))
        return {};
    LoopState state;
    Vec3 pin;
    if (slides_) {
        const Plane from_pin = in_plane(crank - pin_);
        const double ratio = from_pin.across / coupler_length_;
        state.transmission = std::sqrt(std::max(0.0, (1 - ratio) * (1 + ratio)));
        state.closer = from_pin.along + side_ * coupler_length_ * state.transmission;
        pin = pin_ + state.closer * along_;
    } else {
        const Plane way = in_plane(crank - centre_);
        const double d = std::hypot(way.along, way.across);
        const double r = closer_length_;
        const double l = coupler_length_;
        const double cosine = (r * r + l * l - d * d) / (2 * r * l); // at the pin
        if (!(std::abs(cosine) <= 1) || !(d > 0))
            return {};
        state.transmission = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
        // The pin lies at distance r from the centre and l from the crank's pin.
        const double a = (r * r - l * l + d * d) / (2 * d);
        const double h = side_ * r * l * state.transmission / d;
        const double along = (a * way.along - h * way.across) / d;
        const double across = (a * way.across + h * way.along) / d;
        pin = centre_ + along * along_ + across * across_;
        state.closer = closer_sign_ * angle_about(axis_, pin_ - centre_, pin - centre_);
    }
    if (state.transmission < kLeastTransmission)
        return {};
    const Vec3 back = apply(inverse(closer_from_coupler), pin);
    state.coupler = angle_about(axis_, pin_ - crank_pin_, back - crank_pin_);
    return state;
}

double LoopGeometry::least_transmission(const Transform& closer_from_coupler, double way) const {
    const Vec3 crank = apply(closer_from_coupler, crank_pin_);
    if (slides_) {
        const double ratio = (std::abs(in_plane(crank - pin_).across) + way) / coupler_length_;
        return ratio < 1 ? std::sqrt((1 - ratio) * (1 + ratio)) : 0;
    }
    const Plane from_centre = in_plane(crank - centre_);
    const double d = std::hypot(from_centre.along, from_centre.across);
    const double r = closer_length_;
    const double l = coupler_length_;
    const auto sine = [&](double distance) {
        const double cosine = (r * r + l * l - distance * distance) / (2 * r * l);
        return std::abs(cosine) < 1 ? std::sqrt((1 - cosine) * (1 + cosine)) : 0;
    };
    // The sine is least at one end: the cosine falls with the distance.
    return std::min(sine(std::max(0.0, d - way)), sine(d + way));
}

} // namespace abut
