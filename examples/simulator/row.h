#pragma once

#include "simulator/body.h"

#include <algorithm>
#include <numbers>

namespace simulation {

/// One scalar constraint on the velocities of two bodies. Contacts have three at each point, joints
/// three to five. Its speed is
///
///     along . (v_b - v_a) + turn_b . w_b - turn_a . w_a
///
/// and an impulse acts on both bodies along the same directions, so that momentum is conserved.
struct Row {
    Vec3 along, turn_a, turn_b;
    Vec3 spin_a, spin_b; ///< changes of spin by a unit impulse
    double mass = 0;     ///< the impulse that changes the speed by 1
    double impulse = 0;  ///< accumulated over the step

    [[nodiscard]] double speed(const Body& a, const Body& b) const {
        return dot(along, b.velocity - a.velocity) + dot(turn_b, b.spin) - dot(turn_a, a.spin);
    }
    /// The same of the motion since the begin of the step: by how much the bodies have separated.
    [[nodiscard]] double moved(const Body& a, const Body& b) const {
        return dot(along, b.moved - a.moved) + dot(turn_b, b.turned) - dot(turn_a, a.turned);
    }
    void apply(double change, Body& a, Body& b) const {
        a.velocity = a.velocity - (change * a.inverse_mass) * along;
        a.spin = a.spin - change * spin_a;
        b.velocity = b.velocity + (change * b.inverse_mass) * along;
        b.spin = b.spin + change * spin_b;
    }
    void add_impulse(double change, Body& a, Body& b) {
        impulse += change;
        apply(change, a, b);
    }
};

/// Returns a row with its mass. `along` is zero where only rotations count.
inline Row make_row(const Body& a, const Body& b, const Vec3& along, const Vec3& turn_a,
                    const Vec3& turn_b) {
    Row row{along, turn_a, turn_b, a.inverse_inertia * turn_a, b.inverse_inertia * turn_b, 0, 0};
    const double yield = (a.inverse_mass + b.inverse_mass) * dot(along, along) +
                         dot(turn_a, row.spin_a) + dot(turn_b, row.spin_b);
    row.mass = yield > 0 ? 1 / yield : 0;
    return row;
}
/// Of two points, at these arms from the centres of mass, that move along a direction.
inline Row point_row(const Body& a, const Body& b, const Vec3& arm_a, const Vec3& arm_b,
                     const Vec3& along) {
    return make_row(a, b, along, cross(arm_a, along), cross(arm_b, along));
}

/// A constraint that acts as a spring with a damper, in an implicit step that is stable for any
/// stiffness: a position error is corrected at `rate` per second, and the impulse is reduced.
/// Source: soft constraints [Catto 2011].
struct Softness {
    double rate = 0, mass = 1, impulse = 0;

    static Softness of(double hertz, double damping, double seconds) {
        const double omega = 2 * std::numbers::pi * hertz, a = 2 * damping + seconds * omega,
                     b = seconds * omega * a;
        return {omega / a, b / (1 + b), 1 / (1 + b)};
    }
    static Softness rigid() { return {}; }
};

} // namespace simulation
