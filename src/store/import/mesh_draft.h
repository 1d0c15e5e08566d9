#pragma once

#include <abut/mesh.h>

#include "core/hash.h"
#include "io/scene/scene_source.h"
#include "store/codec/mesh_codec.h"
#include "store/database/schema.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace abut {

/// A mesh block that has no number in the store yet.
struct BlockDraft {
    BlockRow row;
    std::vector<std::byte> data;
};

/// A mesh as read_scene gives it, with the data of its row in the store.
struct MeshDraft {
    Mesh mesh;
    Hash128 hash;
    /// It bounds a solid; of a mesh that is cut into blocks, whether it is closed.
    std::optional<bool> closed;
    Box3 box;
};

/// The hash of a mesh, from the hashes of its positions (as doubles) and of its triangles. A mesh
/// on disk yields these one after the other.
Hash128 mesh_hash(std::uint64_t vertices, const Hash128& positions, std::uint64_t triangles,
                  const Hash128& corners);

/// Reads a mesh, joins its vertices and checks it.
///
/// Errors      Fault bad_mesh, also where require_valid throws Error{bad_mesh}; as
///             SceneSource::read.
MeshDraft load_mesh(const SceneSource& source, std::uint32_t mesh);

/// The memory that load_mesh and encode_mesh take at most, to within some 20 %.
std::uint64_t loading_bytes(const SceneSource::Size& size);

/// Packs a mesh block. Its box is that of the vertices that its triangles use.
BlockDraft encode_draft(const MeshBlock& block);

/// Packs the mesh blocks of a mesh in memory.
std::vector<BlockDraft> encode_mesh(const Mesh& mesh);

/// Whether every edge is used by exactly two triangles, and there is an edge. Gives the same answer
/// as is_closed of the mesh's topology, in a third of the memory.
///
/// In          a mesh without two vertices at equal positions.
bool is_closed_joined(const Mesh& mesh);

/// Throws a Fault if a coordinate is beyond the range of queries.
void check_coordinate(const Vec3& position, std::uint64_t vertex);

} // namespace abut
