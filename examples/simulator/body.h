#pragma once

#include <abut/world.h>

#include "simulator/mass.h"

#include <cstddef>

namespace simulation {

using BodyNumber = std::size_t;

struct Material {
    double density = 1000; ///< 0: the body is static
    double friction = 0.5; ///< of two bodies: the geometric mean
    double bounce = 0;     ///< restitution, at most 1; of two bodies: the larger one
    /// Coefficient of rolling resistance, in metres: the arm by which the push of a contact slows
    /// rolling. It also slows spinning about the normal. Of two bodies: the larger one.
    double rolling = 0.001;
};

/// A rigid body. A static body has mass 0, and its inverse mass and inertia are 0 too.
struct Body {
    abut::BodyId id; ///< in the world
    Material material;
    Mass mass;        ///< in the frame of the shape
    double reach = 0; ///< no point of the shape is farther from the centre of mass

    Vec3 position; ///< of the centre of mass
    Quaternion rotation{1, 0, 0, 0};
    Vec3 velocity, spin;
    Pose pose; ///< of the shape, as the world has it

    double inverse_mass = 0;
    Matrix inverse_inertia = kZeroMatrix; ///< along the axes of the world

    /// The motion since the begin of the step: of the centre, and the sum of small rotations.
    Vec3 moved, turned;

    double still_for = 0; ///< seconds
    bool asleep = false;

    [[nodiscard]] bool is_static() const { return mass.mass == 0; }
    [[nodiscard]] bool moves() const { return !is_static() && !asleep; }
};

/// Returns the pose of the shape for the body's position and rotation.
Pose current_pose(const Body& body);
/// Returns the inertia about the centre of mass, along the axes of the world.
Matrix world_inertia(const Body& body);
/// Sets `inverse_inertia` for the current rotation.
void update_inertia(Body& body);
/// Moves and turns the body for a time, as if nothing touches it.
///
/// Accuracy    angular momentum and the energy of the rotation are conserved to rounding, if the
///             body turns by at most a radian in this time. Beyond it, Newton's method may not
///             converge, and both may change.
/// Source      midpoint rule with the Cayley map [Simo, Wong 1991].
void drift(Body& body, double seconds);
/// The kinetic energy.
double kinetic_energy(const Body& body);

} // namespace simulation
