#pragma once

#include <abut/mesh.h>
#include <abut/shapes.h>

#include "simulator.h"

#include <vector>

namespace drop {

/// Returns the triangles of a shape, for display.
abut::Mesh surface_of(const abut::Sphere& sphere);
abut::Mesh surface_of(const abut::Capsule& capsule);
abut::Mesh surface_of(const abut::Box3& box);

/// One mesh for each body of a simulator. An empty mesh is not shown.
struct Surfaces {
    std::vector<abut::Mesh> of_body;
    /// Returns all meshes at the current places of the bodies.
    [[nodiscard]] abut::Mesh placed(Simulator& simulator) const;
};

} // namespace drop
