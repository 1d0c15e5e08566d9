#pragma once

#include <abut/types.h>

#include <assimp/scene.h>
#include <string>
#include <vector>

namespace abut {

/// A node with triangles, before its meshes are joined.
struct NodePart {
    std::string id;
    std::string name; ///< empty if it equals the id
    std::string type;
    Transform world_from_node;
    std::vector<unsigned> meshes; ///< indices in aiScene, only of meshes with triangles, in order
    bool has_material = true;     ///< false: the material that Assimp gives it is not the file's
};

/// Returns whether a mesh has triangles or polygons, not only points and lines.
bool has_surface(const aiMesh& mesh);

/// Makes parts from the tree of nodes; transforms are composed in double.
///
/// Errors      Fault malformed for a projective matrix.
std::vector<NodePart> assimp_parts(const aiScene& scene);

} // namespace abut
