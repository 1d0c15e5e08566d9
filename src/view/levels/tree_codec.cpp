#include "view/levels/tree_codec.h"

#include "io/file/fault.h"
#include "store/codec/zstd_frame.h"

#include <array>
#include <cstring>
#include <type_traits>

namespace abut {

namespace {

constexpr std::uint64_t kLargestTreeBytes = std::uint64_t{1} << 36;

/// Applies take(list) to all lists of a tree, always in the same order.
template <typename Tree, typename Take>
void for_each_list(Tree& tree, const Take& take) {
    take(tree.nodes);
    take(tree.instances);
    take(tree.meshes);
    take(tree.mesh_levels);
    take(tree.chunks);
    take(tree.chunk_rows);
    take(tree.parts);
}

bool is_range(std::uint64_t first, std::uint64_t count, std::uint64_t size) {
    return first <= size && count <= size - first;
}

bool is_chunk(std::uint32_t chunk, const LevelTree& tree) {
    return chunk == kNoChunk || chunk < tree.chunks.size();
}

bool is_sound(const LevelTree& tree) {
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const LevelNode& node = tree.nodes[i];
        if (!is_range(node.first_child, node.children, tree.nodes.size()) ||
            (node.children > 0 && node.first_child <= i) || !is_chunk(node.chunk, tree) ||
            (node.instance != kNoChunk && node.instance >= tree.instances.size()))
            return false;
    }
    for (const LevelInstance& instance : tree.instances)
        if (instance.mesh >= tree.meshes.size() || instance.placed.part >= tree.parts.size())
            return false;
    for (const LevelMesh& mesh : tree.meshes)
        if (!is_range(mesh.first_level, mesh.levels, tree.mesh_levels.size()))
            return false;
    for (const MeshLevel& level : tree.mesh_levels)
        if (level.chunk >= tree.chunks.size())
            return false;
    return !tree.nodes.empty() && tree.chunks.size() == tree.chunk_rows.size();
}

} // namespace

std::vector<std::byte> encode_tree(const LevelTree& tree) {
    std::vector<std::byte> raw;
    const auto append = [&](const void* from, std::size_t bytes) {
        if (bytes == 0)
            return;
        const std::size_t at = raw.size();
        raw.resize(at + bytes);
        std::memcpy(raw.data() + at, from, bytes);
    };
    append(&tree.origin, sizeof tree.origin);
    for_each_list(tree, [&](const auto& list) {
        const std::uint64_t count = list.size();
        append(&count, sizeof count);
    });
    for_each_list(tree, [&](const auto& list) {
        static_assert(std::is_trivially_copyable_v<std::decay_t<decltype(list[0])>>);
        append(list.data(), list.size() * sizeof list[0]);
    });
    return compress(raw);
}

LevelTree decode_tree(std::span<const std::byte> data) {
    const std::uint64_t bytes = content_bytes(data);
    LevelTree tree;
    std::array<std::uint64_t, 7> counts{};
    if (bytes < sizeof tree.origin + sizeof counts || bytes > kLargestTreeBytes)
        malformed("the tree of levels has a wrong length");
    const std::vector<std::byte> raw = decompress(data, bytes);
    std::span<const std::byte> rest(raw);
    const auto take = [&](void* to, std::uint64_t count, std::uint64_t size) {
        if (rest.size() / size < count)
            malformed("the tree of levels is too short");
        if (count > 0)
            std::memcpy(to, rest.data(), count * size);
        rest = rest.subspan(count * size);
    };
    take(&tree.origin, 1, sizeof tree.origin);
    take(counts.data(), counts.size(), sizeof counts[0]);
    std::size_t at = 0;
    for_each_list(tree, [&](auto& list) {
        const std::uint64_t count = counts.at(at++);
        if (rest.size() / sizeof list[0] < count)
            malformed("the tree of levels is too short");
        list.resize(count);
        take(list.data(), count, sizeof list[0]);
    });
    if (!rest.empty() || !is_sound(tree))
        malformed("the tree of levels is wrong");
    return tree;
}

} // namespace abut
