#pragma once

#include <abut/mesh.h>
#include <abut/shapes.h>

#include "simulator.h"

#include <vector>

namespace drop {

/// Triangles of a shape, to look at.
abut::Mesh surface_of(const abut::Sphere& sphere);
abut::Mesh surface_of(const abut::Capsule& capsule);
abut::Mesh surface_of(const abut::Box3& box);

/// One mesh for each body of a simulator; an empty one is not shown.
struct Surfaces {
    std::vector<abut::Mesh> of_body;
    /// All of them where the bodies are.
    [[nodiscard]] abut::Mesh placed(Simulator& simulator) const;
};

} // namespace drop
