#pragma once

#include <abut/convex.h>
#include <abut/mesh.h>
#include <abut/model.h>
#include <abut/scene.h>
#include <abut/shapes.h>

#include "simulator/simulator.h"

#include <vector>

namespace simulation {

/// Returns the triangles of a shape, for display.
abut::Mesh surface_of(const abut::Sphere& sphere);
abut::Mesh surface_of(const abut::Capsule& capsule);
abut::Mesh surface_of(const abut::Box3& box);
abut::Mesh surface_of(const abut::Convex& convex);
abut::Mesh surface_of(const abut::Model& model);

/// A ball with eight bumps: a closed surface that is not convex.
abut::Mesh bumpy_ball(double radius);
/// A round disc with a dent in each side, like a red blood cell: closed, and not convex.
abut::Mesh dented_disc(double radius);

/// One mesh for each body of a simulator.
struct Surfaces {
    std::vector<abut::Mesh> of_body;
    /// Returns all meshes at the current places of the bodies.
    [[nodiscard]] abut::Mesh placed(const Simulator& simulator) const;
    /// The same as parts with colours: static bodies are grey, those asleep are pale.
    [[nodiscard]] abut::Scene scene(const Simulator& simulator) const;
};

} // namespace simulation
