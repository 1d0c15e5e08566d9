#include "view/levels/chunk_maker.h"

#include "math/transform.h"
#include "store/import/cut_mesh.h"
#include "view/levels/chunk_codec.h"
#include "view/levels/shaded_mesh.h"
#include "view/simplify/simplify_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace abut {

namespace {

constexpr std::uint32_t kLeastTriangles = 64; ///< of a level of a shared mesh
constexpr std::uint32_t kReduction = 4;       ///< triangles of children to those of their parent
/// Of a parent. With three vertices each, they stay below 65,536 vertices.
constexpr std::uint32_t kMostTriangles = 16384;

Box3 box_of(const LevelSurface& surface) {
    Box3 box;
    for (const auto& t : surface.triangles)
        for (const std::uint32_t v : t)
            extend(box, surface.vertices[v].position);
    return box;
}

MadeChunk pack(const PartChunk& chunk, const Box3& box, double error) {
    MadeChunk made;
    made.row.vertices = static_cast<std::uint32_t>(chunk.chunk.vertices.size());
    made.row.triangles = static_cast<std::uint32_t>(chunk.chunk.indices.size() / 3);
    made.row.error = error;
    made.row.box = box;
    const Box3 drawn = box_of(surface_of(chunk));
    if (!is_empty(drawn)) {
        extend(made.row.box, drawn.lower);
        extend(made.row.box, drawn.upper);
    }
    made.data = encode_chunk(chunk);
    return made;
}

MadeChunk pack_leaf(const LevelSurface& surface, int least_exponent) {
    const Box3 box = box_of(surface);
    const ChunkGrid grid = grid_of(is_empty(box) ? Box3{{}, {}} : box, least_exponent);
    return pack(quantise(surface, grid, true), box, grid.error());
}

/// The numbers of a mesh's triangles in one of `slices` parts, along a Morton curve.
std::vector<std::uint32_t> slice_of(const Mesh& mesh, std::uint32_t slice, std::uint32_t slices) {
    Box3 box;
    for (const Vec3& p : mesh.positions)
        extend(box, p);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        order.emplace_back(
            spatial_key(box, mesh.positions[a], mesh.positions[b], mesh.positions[c]), i);
    }
    std::sort(order.begin(), order.end());
    const auto cut = [&](std::uint64_t k) { return order.size() * k / slices; };
    std::vector<std::uint32_t> chosen;
    for (std::size_t i = cut(slice); i < cut(std::uint64_t{slice} + 1); ++i)
        chosen.push_back(order[i].second);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

Mesh read_item(StoreFile& store, const LevelItem& item, const PartRow& part) {
    return item.block != 0 ? store.read_block(item.block).mesh : store.read_mesh(part.mesh);
}

} // namespace

MadeChunk make_leaf(StoreFile& store, std::span<const LevelItem> items, const Vec3& origin,
                    std::uint32_t slice, std::uint32_t slices) {
    LevelSurface surface;
    for (const LevelItem& item : items)
        surface.parts.push_back(item.part);
    std::sort(surface.parts.begin(), surface.parts.end());
    surface.parts.erase(std::unique(surface.parts.begin(), surface.parts.end()),
                        surface.parts.end());
    surface.errors.assign(surface.parts.size(), 0);
    int least_exponent = -1000;
    for (const LevelItem& item : items) {
        const PartRow part = store.part(item.part);
        const Mesh mesh = read_item(store, item, part);
        const auto number = static_cast<std::uint32_t>(
            std::lower_bound(surface.parts.begin(), surface.parts.end(), item.part) -
            surface.parts.begin());
        const Transform place = translated(part.world_from_mesh, -origin);
        if (slice == kNoSlice)
            add_shaded(mesh, place, number, surface);
        else
            add_shaded(mesh, slice_of(mesh, slice, slices), place, number, surface);
        if (item.block != 0 || slice != kNoSlice) {
            // All leaves of the mesh have one grid, so that their borders have equal vertices.
            const Box3 whole{part.box.lower - origin, part.box.upper - origin};
            least_exponent = std::max(least_exponent, grid_of(whole, -1000).exponent - 4);
        }
    }
    return pack_leaf(surface, least_exponent);
}

std::vector<MadeChunk> make_mesh_levels(StoreFile& store, std::int64_t mesh, const Vec3& centre) {
    LevelSurface surface;
    surface.parts = {kSharedMesh};
    surface.errors = {0};
    add_shaded(store.read_mesh(mesh), translated(Transform(), -centre), 0, surface);
    std::vector<MadeChunk> levels;
    levels.push_back(pack_leaf(surface, -1000));
    while (levels.back().row.triangles > kLeastTriangles) {
        std::vector<ChildSurface> child;
        child.push_back(chunk_surface(levels.back().row, levels.back().data));
        MadeChunk coarser = make_parent(std::move(child));
        if (coarser.row.triangles == 0 ||
            coarser.row.triangles * 3 > levels.back().row.triangles * 2)
            break;
        levels.push_back(std::move(coarser));
    }
    return levels;
}

ChildSurface chunk_surface(const LevelChunkRow& row, std::span<const std::byte> data) {
    ChildSurface child{surface_of(decode_chunk(data)), row.box};
    for (double& error : child.surface.errors)
        error = std::min(error, row.error); // a code has a limited range
    child.surface.resting = std::min(child.surface.resting, row.error);
    return child;
}

ChildSurface instance_surface(StoreFile& store, const LevelItem& item, const Vec3& origin) {
    ChildSurface child;
    const PartRow part = store.part(item.part);
    child.surface.parts = {item.part};
    child.surface.errors = {0};
    add_shaded(store.read_mesh(part.mesh), translated(part.world_from_mesh, -origin), 0,
               child.surface);
    child.box = box_of(child.surface);
    return child;
}

namespace {

/// The triangles of all children. A part of several children has the largest of its errors.
LevelSurface merge(const std::vector<ChildSurface>& children) {
    LevelSurface merged;
    for (const ChildSurface& child : children)
        merged.parts.insert(merged.parts.end(), child.surface.parts.begin(),
                            child.surface.parts.end());
    std::sort(merged.parts.begin(), merged.parts.end());
    merged.parts.erase(std::unique(merged.parts.begin(), merged.parts.end()), merged.parts.end());
    merged.errors.assign(merged.parts.size(), 0);
    for (const ChildSurface& child : children) {
        merged.resting = std::max(merged.resting, child.surface.resting);
        std::vector<std::uint32_t> number_of;
        for (std::size_t i = 0; i < child.surface.parts.size(); ++i) {
            const auto found =
                std::lower_bound(merged.parts.begin(), merged.parts.end(), child.surface.parts[i]);
            number_of.push_back(static_cast<std::uint32_t>(found - merged.parts.begin()));
            double& error = merged.errors[number_of.back()];
            error = std::max(error, child.surface.errors[i]);
        }
        const auto base = static_cast<std::uint32_t>(merged.vertices.size());
        for (SurfaceVertex v : child.surface.vertices) {
            v.part = number_of[v.part];
            merged.vertices.push_back(v);
        }
        for (const auto& [a, b, c] : child.surface.triangles)
            merged.triangles.push_back({base + a, base + b, base + c});
    }
    return merged;
}

} // namespace

MadeChunk make_parent(std::vector<ChildSurface> children) {
    Box3 box;
    for (const ChildSurface& child : children)
        if (!is_empty(child.box)) {
            extend(box, child.box.lower);
            extend(box, child.box.upper);
        }
    const LevelSurface merged = merge(children);
    children.clear();
    const auto target = std::min<std::uint32_t>(
        static_cast<std::uint32_t>(merged.triangles.size() / kReduction), kMostTriangles);
    const SimplifiedSurface simple = simplify(merged, target);
    const Box3 kept = box_of(simple.surface);
    const ChunkGrid grid = grid_of(is_empty(kept) ? Box3{{}, {}} : kept, -1000);
    return pack(quantise(simple.surface, grid, true), box, simple.error + grid.error());
}

} // namespace abut
