#include "math/transform.h"
#include "store/import/cut_mesh.h"
#include "view/levels/level_tree.h"
#include "view/levels/quantised_chunk.h"
#include "view/levels/shaded_mesh.h"

#include <numeric>

namespace abut {

namespace {

/// Triangles of a chunk: with three vertices each, it has at most 65,535.
constexpr std::size_t kMostChunkTriangles = 21845;

} // namespace

std::vector<ViewChunk> make_chunks(const Mesh& mesh, const Transform& mesh_to_frame,
                                   std::uint32_t part) {
    Box3 bounds;
    for (const Vec3& p : mesh.positions)
        extend(bounds, p);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        order.emplace_back(
            spatial_key(bounds, mesh.positions[a], mesh.positions[b], mesh.positions[c]), i);
    }
    if (order.size() > kMostChunkTriangles)
        std::sort(order.begin(), order.end());
    std::vector<ViewChunk> chunks;
    for (std::size_t from = 0; from < order.size(); from += kMostChunkTriangles) {
        std::vector<std::uint32_t> chosen;
        for (std::size_t i = from; i < std::min(from + kMostChunkTriangles, order.size()); ++i)
            chosen.push_back(order[i].second);
        std::sort(chosen.begin(), chosen.end());
        LevelSurface surface;
        surface.parts = {kSharedMesh};
        surface.errors = {0};
        add_shaded(mesh, chosen, mesh_to_frame, 0, surface);
        Box3 box;
        for (const SurfaceVertex& v : surface.vertices)
            extend(box, v.position);
        ViewChunk chunk = quantise(surface, grid_of(box, -1000), true).chunk;
        for (ChunkVertex& v : chunk.vertices)
            v.part = part;
        chunks.push_back(std::move(chunk));
    }
    return chunks;
}

} // namespace abut
