#include "store/import/cut_mesh.h"

#include "math/vector.h"

#include <algorithm>

namespace abut {

namespace {

constexpr int kAxisBits = 21;

/// Spreads the bits of a number: two zero bits follow each.
std::uint64_t spread(std::uint64_t v) {
    v = (v | v << 32) & 0x001f00000000ffff;
    v = (v | v << 16) & 0x001f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    return (v | v << 2) & 0x1249249249249249;
}

/// The mean of three coordinates, given by their sum, as a step along an axis. It only affects the
/// order of triangles, so rounding does no harm.
std::uint64_t step(double lower, double extent, double sum) {
    constexpr double kSteps = (1 << kAxisBits) - 1;
    const double share = extent > 0 ? (sum / 3 - lower) / extent : 0;
    return share > 0 ? static_cast<std::uint64_t>(std::min(share, 1.0) * kSteps) : 0; // 0 for NaN
}

} // namespace

std::uint64_t spatial_key(const Box3& bounds, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3& l = bounds.lower;
    // One scale for all axes, so that blocks of a long mesh are short rather than thin.
    const double extent = max_abs(bounds.upper - l);
    return spread(step(l.x, extent, a.x + b.x + c.x)) |
           spread(step(l.y, extent, a.y + b.y + c.y)) << 1 |
           spread(step(l.z, extent, a.z + b.z + c.z)) << 2;
}

void BlockCutter::add(const BlockTriangle& triangle) {
    triangles_.push_back(triangle);
    if (triangles_.size() == most_)
        emit_triangles();
}

void BlockCutter::add_unused(std::uint32_t vertex) {
    unused_.push_back(vertex);
    if (unused_.size() == kLargestWhole)
        emit_unused();
}

void BlockCutter::finish() {
    if (!triangles_.empty())
        emit_triangles();
    if (!unused_.empty())
        emit_unused();
}

void BlockCutter::emit_triangles() {
    // Sorted by number, because numbers are stored as differences.
    std::sort(triangles_.begin(), triangles_.end(),
              [](const BlockTriangle& a, const BlockTriangle& b) { return a.id < b.id; });
    MeshBlock block;
    for (const BlockTriangle& triangle : triangles_) {
        block.triangle_ids.push_back(triangle.id);
        block.vertex_ids.insert(block.vertex_ids.end(), triangle.corners.begin(),
                                triangle.corners.end());
    }
    std::vector<std::uint32_t>& ids = block.vertex_ids;
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    for (const std::uint32_t id : ids)
        block.mesh.positions.push_back(position_(id));
    for (const BlockTriangle& triangle : triangles_) {
        auto& local = block.mesh.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
            local.at(k) = static_cast<std::uint32_t>(
                std::lower_bound(ids.begin(), ids.end(), triangle.corners.at(k)) - ids.begin());
    }
    triangles_.clear();
    emit_(block);
}

void BlockCutter::emit_unused() {
    MeshBlock block;
    block.vertex_ids = std::move(unused_);
    unused_ = {};
    for (const std::uint32_t id : block.vertex_ids)
        block.mesh.positions.push_back(position_(id));
    emit_(block);
}

void cut_mesh(const Mesh& mesh, const std::function<void(const MeshBlock&)>& emit) {
    if (is_whole(mesh.positions.size(), mesh.triangles.size()))
        emit({mesh, {}, {}});
    else
        cut_into_blocks(mesh, kBlockTriangles, emit);
}

void cut_into_blocks(const Mesh& mesh, std::uint64_t most,
                     const std::function<void(const MeshBlock&)>& emit) {
    Box3 bounds;
    for (const Vec3& p : mesh.positions)
        extend(bounds, p);
    std::vector<BlockTriangle> triangles;
    triangles.reserve(mesh.triangles.size());
    std::vector<bool> used(mesh.positions.size());
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& t = mesh.triangles[i];
        triangles.push_back(
            {spatial_key(bounds, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]),
             i, t});
        for (const std::uint32_t v : t)
            used[v] = true;
    }
    std::sort(triangles.begin(), triangles.end());
    BlockCutter cutter([&](std::uint32_t v) { return mesh.positions[v]; }, emit, most);
    for (const BlockTriangle& triangle : triangles)
        cutter.add(triangle);
    for (std::uint32_t v = 0; v < used.size(); ++v)
        if (!used[v])
            cutter.add_unused(v);
    cutter.finish();
}

} // namespace abut
