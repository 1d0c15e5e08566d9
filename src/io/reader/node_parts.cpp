#include "io/reader/node_parts.h"

#include "io/fault.h"
#include "io/reader/affine.h"

#include <string_view>
#include <variant>

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

/// The node's name; empty for names that Assimp made up for formats without names, such as
/// "<STL_BINARY>".
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

/// What is still to be visited, the next one last: no recursion, since files set the depth.
template <typename Node>
struct Visit {
    Node node;
    const aiNode* from_assimp = nullptr;
    Transform world_from_parent;
};

void check_promise(const aiScene& scene, const aiNode& node,
                   const std::vector<GltfTree::Primitive>& primitives, const std::string& id) {
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
        const GltfTree::Primitive& promised = primitives[i];
        if (!promised.is_surface)
            continue;
        if (mesh.mNumVertices != promised.vertices)
            malformed("part " + id + ": only " + std::to_string(mesh.mNumVertices) + " of " +
                      std::to_string(promised.vertices) + " vertices could be read");
        // Assimp leaves out what it cannot draw, without a word.
        if (mesh.mNumFaces != promised.triangles)
            throw Fault(ErrorCode::bad_mesh,
                        "part " + id + ": " + std::to_string(promised.triangles - mesh.mNumFaces) +
                            " of its triangles refer to vertices that do not exist");
    }
}

/// Whether Assimp's node stands for that node of the JSON, as far as one can see.
bool is_same(const aiScene& scene, const GltfTree& tree, const GltfTree::Node& node,
             const aiNode& from_assimp) {
    if (from_assimp.mNumChildren != node.children.size())
        return false;
    const std::size_t primitives =
        node.mesh < 0 ? 0 : tree.meshes[static_cast<std::size_t>(node.mesh)].size();
    if (from_assimp.mNumMeshes != primitives)
        return false;
    for (unsigned i = 0; i < from_assimp.mNumMeshes; ++i)
        if (from_assimp.mMeshes[i] >= scene.mNumMeshes)
            return false;
    return node.name.empty() || own_name(from_assimp).rfind(node.name, 0) == 0;
}

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
    std::vector<Visit<std::monostate>> open{{{}, scene.mRootNode, {}}};
    for (std::size_t number = 0; !open.empty(); ++number) {
        const auto visit = open.back();
        open.pop_back();
        const aiNode& node = *visit.from_assimp;
        const Transform world = compose(visit.world_from_parent, local_transform(node));
        for (unsigned i = node.mNumChildren; i-- > 0;)
            open.push_back({{}, node.mChildren[i], world});
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

std::vector<NodePart> gltf_parts(const aiScene& scene, const GltfTree& tree) {
    std::vector<NodePart> parts;
    std::vector<Visit<std::uint32_t>> open;
    // Assimp puts several roots below one of its own.
    const aiNode& root = *scene.mRootNode;
    if (tree.roots.size() == 1)
        open.push_back({tree.roots.front(), &root, {}});
    else if (root.mNumChildren != tree.roots.size())
        return {};
    else
        for (std::size_t i = tree.roots.size(); i-- > 0;)
            open.push_back({tree.roots[i], root.mChildren[i], {}});

    while (!open.empty()) {
        const auto visit = open.back();
        open.pop_back();
        const GltfTree::Node& node = tree.nodes[visit.node];
        const aiNode& from_assimp = *visit.from_assimp;
        if (!is_same(scene, tree, node, from_assimp))
            return {};
        const Transform world = compose(visit.world_from_parent, node.parent_from_node);
        for (std::size_t i = node.children.size(); i-- > 0;)
            open.push_back({node.children[i], from_assimp.mChildren[i], world});
        NodePart part{node.name, node.extras_name, node.extras_type, world,
                      surfaces(scene, from_assimp)};
        if (part.id.empty())
            part.id = "node " + std::to_string(visit.node);
        if (node.mesh >= 0)
            check_promise(scene, from_assimp, tree.meshes[static_cast<std::size_t>(node.mesh)],
                          part.id);
        if (!part.meshes.empty())
            parts.push_back(std::move(part));
    }
    return parts;
}

} // namespace abut
