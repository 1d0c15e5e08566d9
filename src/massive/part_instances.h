#pragma once

#include <abut/scene.h>

#include <cstdint>
#include <vector>

namespace abut {

/// One part of one of the models, in a numbering over all.
struct PartInstance {
    std::uint32_t model = 0, part = 0;
    std::uint32_t mesh = 0; ///< index in PartInstances::meshes
    Transform world_from_mesh;
    Box3 box; ///< world box of the vertices that triangles use; empty if there is no triangle
};

/// The parts of all models, in the frame of the first.
struct PartInstances {
    std::vector<PartInstance> parts; ///< by model, then as in the model
    std::vector<const Mesh*> meshes; ///< all models' meshes; no copies
};

/// Errors      Error{bad_mesh}, naming the model's file: a part names a mesh that is not there, an
///             index or a coordinate is out of range, a transform is not finite.
/// Cost        one transform of every vertex of every instance; parallel.
PartInstances gather_parts(const std::vector<Scene>& models);

} // namespace abut
