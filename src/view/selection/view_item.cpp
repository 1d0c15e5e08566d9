#include "view/selection/view_item.h"

#include <abut/error.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace abut {

namespace {

/// Whether a range of numbers lies in [0, size).
bool is_within(std::uint64_t first, std::uint64_t count, std::size_t size) {
    return first + count <= size;
}

bool is_chunk_or_none(const LevelTree& tree, std::uint32_t chunk) {
    return chunk == kNoChunk || chunk < tree.chunks.size();
}

bool is_error(float error) {
    return error >= 0 && std::isfinite(error);
}

bool is_node(const LevelTree& tree, std::size_t at) {
    const LevelNode& node = tree.nodes[at];
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!std::isfinite(node.lower.at(axis)) || !std::isfinite(node.upper.at(axis)))
            return false;
    const bool is_leaf = node.children == 0;
    const bool in_range =
        is_leaf ||
        (node.first_child > at && is_within(node.first_child, node.children, tree.nodes.size()));
    const bool has_instance = node.instance != kNoChunk;
    return in_range && is_error(node.error) && is_chunk_or_none(tree, node.chunk) &&
           (!has_instance || (is_leaf && node.instance < tree.instances.size()));
}

/// Whether every node but the root has one parent. With more, a walk could take forever.
bool has_one_parent_each(const LevelTree& tree) {
    std::vector<bool> has_parent(tree.nodes.size());
    std::size_t children = 0;
    for (const LevelNode& node : tree.nodes)
        for (std::uint32_t i = 0; i < node.children; ++i, ++children) {
            if (has_parent[node.first_child + i])
                return false;
            has_parent[node.first_child + i] = true;
        }
    return children + 1 == tree.nodes.size() || tree.nodes.empty();
}

} // namespace

void check_level_tree(const LevelTree& tree, const std::string& store) {
    const auto need = [&](bool condition, const char* what) {
        if (!condition)
            throw Error(ErrorCode::malformed, store,
                        std::string("its levels are damaged: ") + what);
    };
    need(std::isfinite(tree.origin.x) && std::isfinite(tree.origin.y) &&
             std::isfinite(tree.origin.z),
         "the origin is not finite");
    for (std::size_t at = 0; at < tree.nodes.size(); ++at)
        need(is_node(tree, at), "a node is out of range");
    need(has_one_parent_each(tree), "a node has no parent, or two");
    for (const LevelMesh& mesh : tree.meshes)
        need(mesh.levels > 0 && is_within(mesh.first_level, mesh.levels, tree.mesh_levels.size()),
             "a mesh has no levels");
    for (const MeshLevel& level : tree.mesh_levels)
        need(is_error(level.error) && level.chunk < tree.chunks.size(),
             "a level of a mesh is out of range");
    for (const LevelInstance& instance : tree.instances)
        need(instance.mesh < tree.meshes.size() && instance.placed.part < tree.parts.size() &&
                 is_error(instance.scale),
             "an instance is out of range");
}

} // namespace abut
