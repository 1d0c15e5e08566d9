#pragma once

#include <abut/scene.h>

#include <cstdint>
#include <vector>

namespace abut {

/// A part as the clash job sees it: a mesh and a transform.
struct PartInstance {
    std::uint32_t model = 0, part = 0;
    std::uint32_t mesh = 0; ///< index in PartInstances::meshes
    Transform world_from_mesh;
    Box3 box;            ///< world box of the vertices that triangles use; empty without triangles
    double rounding = 0; ///< as single_rounding
};

/// The parts of all models, in the frame of the first model.
struct PartInstances {
    std::vector<PartInstance> parts; ///< by model, then in the model's order
    std::vector<const Mesh*> meshes; ///< meshes of all models, not copied
};

/// Lists the parts of all models and computes their world boxes.
///
/// Errors      Error{bad_mesh}, naming the model's file: a part names a mesh that does not exist,
///             an index or a coordinate is out of range, or a transform is not finite.
/// Cost        transforms each vertex of each part instance once; parallel.
PartInstances gather_parts(const std::vector<Scene>& models);

} // namespace abut
