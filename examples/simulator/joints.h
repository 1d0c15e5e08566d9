#pragma once

#include "simulator/row.h"
#include "simulator/settings.h"

#include <cstdint>
#include <span>

namespace simulation {

/// ball: a point of b stays at a point of a. hinge: b also turns about an axis of a only. slider:
/// b moves along an axis of a only, and does not turn.
enum class JointKind : std::uint8_t { ball, hinge, slider };

/// Where a joint is, in the frame of the world, when it is made.
struct JointPlace {
    Vec3 point;
    Vec3 axis{0, 0, 1}; ///< of a hinge or a slider
};

/// Joins two bodies, one of which may be static.
class Joint {
public:
    Joint(JointKind kind, BodyNumber a, BodyNumber b, const JointPlace& place,
          std::span<const Body> bodies);

    /// Sets up the rows for the current places of the bodies.
    void prepare(std::span<const Body> bodies);
    void apply_known(std::span<Body> bodies) const;
    void solve(std::span<Body> bodies, const Settings& settings, double h, bool springs);

    [[nodiscard]] BodyNumber a() const { return a_; }
    [[nodiscard]] BodyNumber b() const { return b_; }
    /// By how far the points, or the lines, of the two bodies are apart.
    [[nodiscard]] double gap(std::span<const Body> bodies) const;
    /// The angle by which b has turned otherwise than the joint allows.
    [[nodiscard]] double twist(std::span<const Body> bodies) const;

private:
    /// What the joint forbids, in the frame of the world.
    struct Error {
        Vec3 arm_a, arm_b; ///< from the centres of mass to the points of the bodies
        Vec3 apart;        ///< from the point of a to that of b, without what a slider allows
        Vec3 turned;       ///< the rotation of b, without what a hinge allows
        Vec3 axis;
    };
    [[nodiscard]] Error error(const Body& a, const Body& b) const;

    JointKind kind_;
    BodyNumber a_, b_;
    Vec3 point_a_, point_b_; ///< from the centres of mass, in the bodies' frames
    Vec3 axis_a_, axis_b_;   ///< in the bodies' frames
    Quaternion b_in_a_{};    ///< rotation of b in the frame of a
    std::array<Row, 5> rows_;
    std::array<double, 5> errors_{};
    std::size_t count_; ///< of rows
};

} // namespace simulation
