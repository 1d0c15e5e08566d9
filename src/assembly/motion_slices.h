#pragma once

#include "articulated/placed_bodies.h"
#include "assembly/kinematics.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A span of time between two keys, in which every joint with keys moves at a constant rate.
struct TimeSlice {
    double start = 0, end = 0;
};

/// Bounds of the motion of parts in one slice of time. Reuse it for many slices.
///
/// A bound follows the chain of joints from one part to another. At each joint it adds the joint's
/// rate times the distance of the body from the joint's axis. The distance is that in the middle of
/// the slice, plus how far the joints before can have moved the body since.
class SliceMotion {
public:
    explicit SliceMotion(const AssemblyKinematics& kinematics);

    /// In          parts: as AssemblyKinematics::place.
    /// Errors      as AssemblyKinematics::place.
    void set(const TimeSlice& slice, std::span<const std::uint32_t> parts);

    /// Whether all loops of the parts have bounds: the slice is short enough, and no dead point is
    /// near.
    [[nodiscard]] bool is_bounded() const { return is_bounded_; }
    /// A bound of the speed of any point of one body relative to the other body.
    [[nodiscard]] double relative_speed(const RobotBody& a, const RobotBody& b) const;
    /// A box that encloses the body during the whole slice.
    [[nodiscard]] Box3 swept_box(const RobotBody& body, const Transform& owner_from_model) const;

private:
    /// A joint as a bound needs it. It turns about an axis, or about any axis through a point.
    struct Turning {
        Vec3 centre, axis; ///< world, in the middle of the slice; the axis is zero for any axis
        JointRate rate;
    };
    /// Bounds of the motion of one ball as seen from a frame.
    struct Way {
        double speed = 0, turn = 0;
    };
    /// The first steps of a walk go by the loops' pins, not by the couplers' own joints.
    struct Detours {
        bool from = false, to = false;
    };

    [[nodiscard]] Turning joint(std::uint32_t part) const;
    [[nodiscard]] Turning pin_joint(std::uint32_t coupler) const;
    [[nodiscard]] Way walk(std::uint32_t from, std::uint32_t to, const Vec3& point, double radius,
                           Detours detours) const;
    [[nodiscard]] double seen_from(const RobotBody& body, std::uint32_t other) const;
    void bound_loop(std::uint32_t loop);
    [[nodiscard]] const Transform& place_of(std::uint32_t part) const {
        return part == AssemblyKinematics::kNone ? world_ : places_[part];
    }

    const AssemblyKinematics& kinematics_;
    std::vector<Transform> places_; ///< displacements in the middle of the slice
    std::vector<JointRate> rates_;
    std::vector<double> pin_turns_; ///< of each loop: of the coupler relative to the closer
    Transform world_;
    double half_ = 0; ///< of the slice's length
    bool is_bounded_ = true;
};

/// Cuts the time of an assembly's motion into slices that are short enough for good bounds.
///
/// Errors      Error{bad_argument} if nothing moves, or if a loop cannot close or comes to a dead
///             point, naming it and the time; Error{interrupted}.
std::vector<TimeSlice> cut_into_slices(const AssemblyKinematics& kinematics);

} // namespace abut
