#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include "math/vector.h"

#include <vector>

namespace abut {

/// The boxes of runs of consecutive triangles of a mesh, which let a search skip most of it.
class MeshRuns {
public:
    explicit MeshRuns(const Mesh& mesh);

    /// Appends the triangles whose boxes under the transform meet a box.
    void gather(const Mesh& mesh, const Transform& world_from_mesh, const Box3& box,
                std::vector<Triangle>& triangles) const;

    [[nodiscard]] std::size_t bytes() const { return boxes_.size() * sizeof(Box3); }

private:
    std::vector<Box3> boxes_; ///< in the mesh's frame
};

/// Returns a box that encloses a box under a transform.
Box3 placed_box(const Box3& box, const Transform& world_from_mesh);

} // namespace abut
