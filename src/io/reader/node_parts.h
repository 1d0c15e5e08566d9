#pragma once

#include <abut/types.h>

#include "io/reader/gltf_tree.h"

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

/// Parts from Assimp's own tree: names and, for glTF, extras from its metadata; transforms composed
/// in double.
///
/// Errors      Fault malformed for a projective matrix.
std::vector<NodePart> assimp_parts(const aiScene& scene);

/// Parts of a glTF file from its JSON, in full precision, with geometry as Assimp read it. Empty if
/// Assimp's tree of nodes is not that of the JSON: then assimp_parts has to do.
///
/// Errors      Fault malformed or bad_mesh if Assimp's meshes have not the sizes that the JSON
///             promises.
std::vector<NodePart> gltf_parts(const aiScene& scene, const GltfTree& tree);

} // namespace abut
