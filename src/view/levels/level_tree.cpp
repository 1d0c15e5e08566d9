#include "view/levels/level_tree.h"

#include <abut/error.h>
#include <abut/levels.h>

#include "io/file/fault.h"
#include "store/database/level_table.h"
#include "view/levels/chunk_codec.h"
#include "view/levels/quantised_chunk.h"
#include "view/levels/shaded_mesh.h"
#include "view/levels/tree_codec.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace abut {

namespace {

template <typename List>
std::uint64_t bytes_of_list(const List& list) {
    return list.capacity() * sizeof list[0];
}

} // namespace

std::uint64_t LevelTree::bytes() const {
    return bytes_of_list(nodes) + bytes_of_list(instances) + bytes_of_list(meshes) +
           bytes_of_list(mesh_levels) + bytes_of_list(chunks) + bytes_of_list(chunk_rows) +
           bytes_of_list(parts);
}

LevelTree read_level_tree(StoreFile& store) {
    const Hash128 content = level_content(store.models());
    std::optional<LevelTreeData> tree = store.with_connection(read_level_tree_data);
    if (!tree)
        throw Error(ErrorCode::bad_argument, store.path(), "has no levels of detail");
    if (!(tree->content == content))
        throw Error(ErrorCode::bad_argument, store.path(),
                    "has levels of detail of earlier parts, or of another version of Abut: "
                    "build them again");
    try {
        return decode_tree(tree->data);
    } catch (const Fault& fault) {
        throw Error(ErrorCode::malformed, store.path(), std::string("is damaged: ") + fault.what());
    }
}

ViewChunk read_level_chunk(StoreFile& store, const LevelTree& tree, std::uint32_t chunk) {
    const std::int64_t row = tree.chunk_rows.at(chunk);
    const std::vector<std::byte> data = store.with_connection(
        [&](Database& database) { return read_level_chunk_data(database, row); });
    const auto damaged = [&](const std::string& what) {
        return Error(ErrorCode::malformed, store.path(),
                     "is damaged: level chunk " + std::to_string(row) + ": " + what);
    };
    try {
        PartChunk read = decode_chunk(data);
        // Numbers of parts in the store become their indices in the tree.
        std::vector<std::uint32_t> index_of;
        for (const std::int64_t part : read.parts) {
            if (part == kSharedMesh) {
                index_of.push_back(0);
                continue;
            }
            const auto found = std::lower_bound(tree.parts.begin(), tree.parts.end(), part);
            if (found == tree.parts.end() || *found != part)
                throw damaged("it shows a part that is not in the store");
            index_of.push_back(static_cast<std::uint32_t>(found - tree.parts.begin()));
        }
        for (ChunkVertex& vertex : read.chunk.vertices)
            vertex.part = index_of.at(vertex.part);
        return std::move(read.chunk);
    } catch (const Fault& fault) {
        throw damaged(fault.what());
    }
}

bool has_levels(const Store& store) {
    StoreFile& file = store.file();
    const std::optional<Hash128> content = file.with_connection(level_tree_content);
    return content && *content == level_content(file.models());
}

} // namespace abut
