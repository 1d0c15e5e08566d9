#pragma once

#include <abut/types.h>
#include <abut/view.h>

#include "store/database/store_file.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace abut {

inline constexpr std::uint32_t kNoChunk = 0xffffffff;

/// A node of the tree of levels. It is drawn by its own chunk, or by its children, or, if it has an
/// instance, by a level of the instance's mesh.
struct LevelNode {
    /// Encloses everything below, and the node's own chunk: world minus LevelTree::origin.
    std::array<float, 3> lower{}, upper{};
    /// No point of the node's chunk is farther than this from the surface that it stands for, and
    /// the other way round; metres. 0 for full detail. At least the children's errors.
    float error = 0;
    std::uint32_t chunk = kNoChunk;
    std::uint32_t first_child = 0, children = 0; ///< children are contiguous and after their parent
    std::uint32_t instance = kNoChunk;           ///< of a leaf: index in LevelTree::instances
};

/// A part whose mesh is shared by other parts.
struct LevelInstance {
    std::uint32_t mesh = 0; ///< index in LevelTree::meshes
    ChunkInstance placed;
    float scale = 1; ///< largest stretch of the matrix: world error = scale * mesh error
};

/// A shared mesh: its levels, coarsest first, are LevelTree::mesh_levels[first_level, + levels). A
/// level is one chunk; a mesh too large for one chunk is not shared but drawn as nodes.
struct LevelMesh {
    std::uint32_t first_level = 0, levels = 0;
};
struct MeshLevel {
    float error = 0; ///< in the mesh's frame; 0 for the last level
    std::uint32_t chunk = kNoChunk;
};

/// Sizes of a chunk once it is read.
struct ChunkSize {
    std::uint32_t triangles = 0, vertices = 0;
    [[nodiscard]] std::uint64_t bytes() const {
        return std::uint64_t{triangles} * 3 * sizeof(std::uint16_t) +
               std::uint64_t{vertices} * sizeof(ChunkVertex);
    }
};

/// The levels of a store, without their geometry. Node 0 is the root. Never changes.
struct LevelTree {
    Vec3 origin;
    std::vector<LevelNode> nodes;
    std::vector<LevelInstance> instances;
    std::vector<LevelMesh> meshes;
    std::vector<MeshLevel> mesh_levels;
    std::vector<ChunkSize> chunks;        ///< by number
    std::vector<std::int64_t> chunk_rows; ///< by number: rows of the table `level_chunk`
    std::vector<std::int64_t> parts;      ///< rows of the table `part`, ascending
    [[nodiscard]] std::uint64_t bytes() const;
};

/// Reads the tree of a store.
///
/// Errors      Error{bad_argument}, naming the store, if it has no levels of its present parts;
///             those of the store.
LevelTree read_level_tree(StoreFile& store);

/// Reads and decodes a chunk. May be called from any thread.
///
/// In          tree: as read from this store; chunk: below tree.chunks.size().
/// Errors      Error{malformed}, naming the store and the chunk, if it is damaged.
ViewChunk read_level_chunk(StoreFile& store, const LevelTree& tree, std::uint32_t chunk);

/// Makes a chunk of a mesh at full detail, for pictures of models that are not in a store. Its
/// vertices are split where faces meet at a crease. A mesh of more than 65,536 triangles, or
/// vertices after the splits, becomes several chunks.
///
/// In          mesh_to_frame: applied to the positions; part: of all vertices.
std::vector<ViewChunk> make_chunks(const Mesh& mesh, const Transform& mesh_to_frame,
                                   std::uint32_t part);

} // namespace abut
