#pragma once

#include <abut/convex.h>
#include <abut/curved_shapes.h>
#include <abut/model.h>
#include <abut/shapes.h>

#include "simulator/rotation.h"

/// Mass, centre of mass and inertia of shapes of uniform density.
namespace simulation {

struct Mass {
    double mass = 0;
    Vec3 centre;                  ///< of mass, in the shape's frame
    Matrix inertia = kZeroMatrix; ///< about the centre of mass, along the shape's axes
};

Mass mass_of(const abut::Sphere& sphere, double density);
Mass mass_of(const abut::Capsule& capsule, double density);
Mass mass_of(const abut::Box3& box, double density);
Mass mass_of(const abut::Cylinder& cylinder, double density);
Mass mass_of(const abut::Cone& cone, double density);
/// Accuracy    exact integrals over tetrahedra, to rounding.
/// Errors      of this and the next two: Error{bad_argument} if the surface encloses no volume,
///             for example because it is inside out. Two cases are not recognised: a flat
///             surface whose volume is positive by rounding, and an open one, whose mass is that of
///             the tetrahedra between its first vertex and its triangles.
Mass mass_of(const abut::Mesh& mesh, double density);
Mass mass_of(const abut::Model& model, double density);
Mass mass_of(const abut::Convex& convex, double density);
/// Errors      Error{bad_argument}: a half-space has no end, so it can only be static.
Mass mass_of(const abut::HalfSpace& half_space, double density);

} // namespace simulation
