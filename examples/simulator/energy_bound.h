#pragma once

#include "simulator/islands.h"

#include <span>
#include <vector>

namespace simulation {

/// Kinetic energy, and potential energy relative to the origin.
double mechanical_energy(const Body& body, const Vec3& gravity);

/// Keeps each group of bodies that touch or are joined from gaining energy in a step.
///
/// The springs that push penetrating bodies apart and close the gaps of joints lift bodies, so a
/// group can gain energy. `enforce` takes the gain out of the group's kinetic energy by scaling
/// velocities. A group that no static body holds keeps its momentum and its angular momentum: only
/// the velocities relative to its motion as one rigid body are scaled.
///
/// Accuracy    the energy still rises if the velocities that may be scaled hold less than the gain.
/// Source      energy projection [Dinev, Liu, Li, Thomaszewski, Kavan 2018], for groups of bodies.
class EnergyBound {
public:
    /// Call it at the begin of a step.
    void remember(std::span<const Body> bodies, const Vec3& gravity);
    /// Call it at the end of the same step, with the groups of that step.
    void enforce(std::span<Body> bodies, Islands& islands, const Vec3& gravity) const;

private:
    std::vector<double> before_; ///< by body
};

} // namespace simulation
