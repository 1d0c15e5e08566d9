#pragma once

#include <abut/mesh.h>

#include "core/hash.h"
#include "io/scene_source.h"
#include "store/mesh_codec.h"
#include "store/schema.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace abut {

/// A block before it has a number in the store.
struct BlockDraft {
    BlockRow row;
    std::vector<std::byte> data;
};

/// A mesh as read_scene gives it, and what the store says of it.
struct MeshDraft {
    Mesh mesh;
    Hash128 hash;
    std::optional<bool> closed;
    Box3 box;
};

/// The hash of a mesh from those of its positions (as doubles) and its triangles, which a mesh on
/// the disk has one after the other.
Hash128 mesh_hash(std::uint64_t vertices, const Hash128& positions, std::uint64_t triangles,
                  const Hash128& corners);

/// Reads a mesh, joins its vertices, checks it.
///
/// Errors      Fault bad_mesh, also for what Error{bad_mesh} of require_valid says; as
///             SceneSource::read.
MeshDraft load_mesh(const SceneSource& source, std::uint32_t mesh);

/// How much memory load_mesh and encode_mesh take at most, some 20 % more or less.
std::uint64_t loading_bytes(const SceneSource::Size& size);

/// Packs a block; its box is that of the vertices that its triangles use.
BlockDraft encode_draft(const MeshBlock& block);

/// The blocks of a mesh in memory.
std::vector<BlockDraft> encode_mesh(const Mesh& mesh);

/// Whether every edge is used by exactly two triangles, and there is an edge; as is_closed of its
/// topology, in a third of the memory.
///
/// In          a mesh without two vertices at equal positions.
bool is_closed_joined(const Mesh& mesh);

/// Throws a Fault if a coordinate is beyond what queries take.
void check_coordinate(const Vec3& position, std::uint64_t vertex);

} // namespace abut
