#include "io/reader/node_parts.h"

#include "io/file/fault.h"
#include "io/reader/affine.h"

#include <string_view>

namespace abut {

namespace {

Transform local_transform(const aiNode& node) {
    const aiMatrix4x4& a = node.mTransformation;
    if (a.d1 != 0 || a.d2 != 0 || a.d3 != 0 || a.d4 != 1)
        malformed(std::string("node ") + node.mName.C_Str() + " has a projective transform");
    return Transform({a.a1, a.b1, a.c1, a.a2, a.b2, a.c2, a.a3, a.b3, a.c3, a.a4, a.b4, a.c4});
}

std::vector<unsigned> surfaces(const aiScene& scene, const aiNode& node) {
    std::vector<unsigned> meshes;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= scene.mNumMeshes)
            malformed("a node refers to a mesh that does not exist");
        if (has_surface(*scene.mMeshes[node.mMeshes[i]]))
            meshes.push_back(node.mMeshes[i]);
    }
    return meshes;
}

/// Returns the node's name; empty for a name that Assimp invented, such as "<STL_BINARY>", because
/// the format has no names.
std::string own_name(const aiNode& node) {
    const std::string_view name(node.mName.data, node.mName.length);
    const bool made_up = name.size() > 2 && name.front() == '<' && name.back() == '>';
    return made_up ? "" : std::string(name);
}

std::string metadata(const aiNode& node, const char* key) {
    aiString value;
    if (node.mMetaData != nullptr && node.mMetaData->Get(key, value))
        return value.C_Str();
    return "";
}

/// Nodes to visit, the next one last. Recursion is avoided because the file determines the depth.
struct Visit {
    const aiNode* node = nullptr;
    Transform world_from_parent;
};

} // namespace

bool has_surface(const aiMesh& mesh) {
    if (mesh.mPrimitiveTypes == aiPrimitiveType_TRIANGLE)
        return mesh.mNumFaces > 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i)
        if (mesh.mFaces[i].mNumIndices >= 3)
            return true;
    return false;
}

std::vector<NodePart> assimp_parts(const aiScene& scene) {
    std::vector<NodePart> parts;
    if (scene.mRootNode == nullptr)
        return parts;
    std::vector<Visit> open{{scene.mRootNode, {}}};
    for (std::size_t number = 0; !open.empty(); ++number) {
        const Visit visit = open.back();
        open.pop_back();
        const aiNode& node = *visit.node;
        const Transform world = compose(visit.world_from_parent, local_transform(node));
        for (unsigned i = node.mNumChildren; i-- > 0;)
            open.push_back({node.mChildren[i], world});
        NodePart part{own_name(node), metadata(node, "name"), metadata(node, "type"), world,
                      surfaces(scene, node)};
        if (part.meshes.empty())
            continue;
        if (part.id.empty())
            part.id = "node " + std::to_string(number);
        parts.push_back(std::move(part));
    }
    return parts;
}

} // namespace abut
