#pragma once

#include <abut/types.h>

#include <assimp/scene.h>
#include <string>
#include <vector>

namespace abut {

/// A node with triangles, before its meshes are joined.
struct NodePart {
    std::string id;
    std::string name; ///< empty: the same as id
    std::string type;
    Transform world_from_node;
    std::vector<unsigned> meshes; ///< in aiScene, only those with triangles, in order
};

/// Whether a mesh holds triangles or polygons, not only points and lines.
bool has_surface(const aiMesh& mesh);

/// Parts from the tree of nodes; transforms composed in double.
///
/// Errors      Fault malformed for a projective matrix.
std::vector<NodePart> assimp_parts(const aiScene& scene);

} // namespace abut
