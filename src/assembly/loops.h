#pragma once

#include <abut/assembly.h>

namespace abut {

/// A loop's chain at one time, in the frame of the part that the closer hangs on.
struct LoopState {
    double coupler = 0, closer = 0; ///< values of the joints
    /// The sine of the angle at which the closer meets the coupler (a slider: the cosine of the
    /// angle between the coupler and the slider's axis), which divides the rates. At least
    /// kLeastTransmission.
    double transmission = 0;
};

/// Loops nearer to a dead point than this are refused.
inline constexpr double kLeastTransmission = 1e-3;

/// The constant data of a loop.
///
/// The plane of a loop is normal to the coupler's axis. All lengths are those in the plane.
class LoopGeometry {
public:
    /// Errors      Error{bad_argument} for a loop that is not planar, or at a dead point at rest.
    LoopGeometry(const Assembly& assembly, const AssemblyLoop& loop, const Vec3& coupler_axis,
                 const Vec3& closer_axis);

    /// Closes the loop. The state is empty (transmission 0) if that is not possible.
    ///
    /// In          closer_from_coupler: maps the frame of the part that the coupler hangs on to
    ///             that of the part that the closer hangs on.
    [[nodiscard]] LoopState solve(const Transform& closer_from_coupler) const;

    /// A lower bound of the transmission while the crank's pin is at most `way` from its place at
    /// this time.
    [[nodiscard]] double least_transmission(const Transform& closer_from_coupler, double way) const;

    /// The length that converts the speed of the crank's pin into the rate of the closer: 1 for a
    /// slider.
    [[nodiscard]] double closer_arm() const { return slides_ ? 1 : closer_length_; }
    [[nodiscard]] double coupler_length() const { return coupler_length_; }
    [[nodiscard]] bool slides() const { return slides_; }
    [[nodiscard]] const Vec3& crank_pin() const { return crank_pin_; }

private:
    struct Plane {
        double along = 0, across = 0;
    };
    [[nodiscard]] Plane in_plane(const Vec3& v) const;

    bool slides_ = true;
    Vec3 crank_pin_, pin_, centre_; ///< at rest; centre: of the closer's joint
    Vec3 axis_;                     ///< of the coupler's joint
    Vec3 along_, across_;           ///< the plane's directions; along: that of the slider
    double coupler_length_ = 0, closer_length_ = 0;
    double side_ = 1;        ///< which of both solutions
    double closer_sign_ = 1; ///< -1: the closer's axis points against the coupler's
};

} // namespace abut
