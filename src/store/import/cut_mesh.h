#pragma once

#include <abut/types.h>

#include "store/codec/mesh_codec.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace abut {

/// Meshes up to this number of vertices and triangles lie in one mesh block. Larger ones are cut
/// into blocks of half the size.
inline constexpr std::uint64_t kLargestWhole = 65536;
inline constexpr std::uint64_t kBlockTriangles = 32768;

/// A triangle to be put into a block. In sorted order, triangles that are close to each other
/// follow each other.
struct BlockTriangle {
    std::uint64_t key = 0;
    std::uint32_t id = 0;
    std::array<std::uint32_t, 3> corners{};
    friend bool operator<(const BlockTriangle& a, const BlockTriangle& b) {
        return a.key != b.key ? a.key < b.key : a.id < b.id;
    }
};

/// Position of a triangle's centre on a space-filling curve through the box, which keeps close
/// points close.
///
/// Source      [Morton 1966], 21 bits an axis.
std::uint64_t spatial_key(const Box3& bounds, const Vec3& a, const Vec3& b, const Vec3& c);

/// Makes blocks of triangles, which must be added in the order of their keys. A mesh in memory and
/// the same mesh on disk give the same blocks.
class BlockCutter {
public:
    /// In          position: returns a vertex by its number; emit: receives each block; most:
    ///             triangles per block.
    BlockCutter(std::function<Vec3(std::uint32_t)> position,
                std::function<void(const MeshBlock&)> emit, std::uint64_t most = kBlockTriangles)
        : position_(std::move(position)), emit_(std::move(emit)), most_(most) {}

    void add(const BlockTriangle& triangle);
    /// Adds a vertex that no triangle uses. Call it after all triangles, with ascending numbers.
    void add_unused(std::uint32_t vertex);
    void finish();

private:
    void emit_triangles();
    void emit_unused();

    std::function<Vec3(std::uint32_t)> position_;
    std::function<void(const MeshBlock&)> emit_;
    std::uint64_t most_;
    std::vector<BlockTriangle> triangles_;
    std::vector<std::uint32_t> unused_;
};

/// Whether a mesh lies in one mesh block.
inline bool is_whole(std::uint64_t vertices, std::uint64_t triangles) {
    return std::max(vertices, triangles) <= kLargestWhole;
}

/// Cuts a mesh in memory, or passes it on whole if it is small.
void cut_mesh(const Mesh& mesh, const std::function<void(const MeshBlock&)>& emit);
/// Cuts a mesh whatever its size. In: most, the triangles per block.
void cut_into_blocks(const Mesh& mesh, std::uint64_t most,
                     const std::function<void(const MeshBlock&)>& emit);

} // namespace abut
