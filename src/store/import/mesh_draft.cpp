#include "store/import/mesh_draft.h"

#include "io/file/fault.h"
#include "io/scene/collect_scene.h"
#include "io/scene/part_checks.h"
#include "math/vector.h"
#include "mesh/topology.h"
#include "mesh/used_positions.h"
#include "rigid/model/solid.h"
#include "store/import/cut_mesh.h"

#include <algorithm>

namespace abut {

Hash128 mesh_hash(std::uint64_t vertices, const Hash128& positions, std::uint64_t triangles,
                  const Hash128& corners) {
    const std::array<std::uint64_t, 6> words{vertices,  positions.low, positions.high,
                                             triangles, corners.low,   corners.high};
    return hash_128(std::as_bytes(std::span(words)));
}

void check_coordinate(const Vec3& p, std::uint64_t vertex) {
    if (const char* const fault = coordinate_fault(p))
        throw Fault(ErrorCode::bad_mesh, "vertex " + std::to_string(vertex) + fault);
}

MeshDraft load_mesh(const SceneSource& source, std::uint32_t number) {
    MeshDraft draft;
    draft.mesh = collect_mesh(source, number);
    const Mesh& mesh = draft.mesh;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        check_coordinate(mesh.positions[i], i);
    draft.hash = mesh_hash(
        mesh.positions.size(), hash_128(std::as_bytes(std::span<const Vec3>(mesh.positions))),
        mesh.triangles.size(),
        hash_128(std::as_bytes(std::span<const std::array<std::uint32_t, 3>>(mesh.triangles))));
    draft.closed = is_whole(mesh.positions.size(), mesh.triangles.size()) ? bounds_solid(mesh)
                                                                          : is_closed_joined(mesh);
    draft.box = world_box(UsedPositions(mesh).get(), Transform());
    return draft;
}

std::uint64_t loading_bytes(const SceneSource::Size& size) {
    // Positions, the table that joins them and their numbers; triangles, their edges, a block.
    return 96 * size.vertices + 72 * size.triangles + 4096;
}

BlockDraft encode_draft(const MeshBlock& block) {
    EncodedBlock encoded = encode_block(block);
    BlockDraft draft;
    draft.row.vertices = block.mesh.positions.size();
    draft.row.triangles = block.mesh.triangles.size();
    draft.row.raw_bytes = encoded.raw_bytes;
    draft.row.box = without_negative_zero(world_box(UsedPositions(block.mesh).get(), Transform()));
    draft.data = std::move(encoded.data);
    return draft;
}

std::vector<BlockDraft> encode_mesh(const Mesh& mesh) {
    std::vector<BlockDraft> blocks;
    cut_mesh(mesh, [&](const MeshBlock& block) { blocks.push_back(encode_draft(block)); });
    return blocks;
}

bool is_closed_joined(const Mesh& mesh) {
    std::vector<std::uint64_t> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        if (a == b || b == c || c == a)
            continue; // a degenerate triangle has no edges
        for (const auto& [v, w] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            edges.push_back(std::uint64_t{std::min(v, w)} << 32 | std::max(v, w));
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); i += 2)
        if (i + 1 == edges.size() || edges[i] != edges[i + 1] ||
            (i + 2 < edges.size() && edges[i + 2] == edges[i]))
            return false;
    return !edges.empty();
}

} // namespace abut
