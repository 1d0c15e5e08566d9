#pragma once

#include <abut/types.h>

#include "store/mesh_codec.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace abut {

/// Meshes up to here lie whole in one block; larger ones are cut into pieces of half the size.
inline constexpr std::uint64_t kLargestWhole = 65536;
inline constexpr std::uint64_t kPieceTriangles = 32768;

/// A triangle on its way into a piece: sorted by these, neighbours come after each other.
struct PieceTriangle {
    std::uint64_t key = 0;
    std::uint32_t id = 0;
    std::array<std::uint32_t, 3> corners{};
    friend bool operator<(const PieceTriangle& a, const PieceTriangle& b) {
        return a.key != b.key ? a.key < b.key : a.id < b.id;
    }
};

/// Where a triangle's centre lies on a curve through the box that keeps near what is near.
///
/// Source      [Morton 1966], 21 bits an axis.
std::uint64_t spatial_key(const Box3& bounds, const Vec3& a, const Vec3& b, const Vec3& c);

/// Makes pieces of triangles that come in the order of their keys: the pieces are the same for a
/// mesh in memory and for one on the disk.
class PieceCutter {
public:
    /// In          position: of a vertex by its number; emit: takes each piece; most: triangles of one.
    PieceCutter(std::function<Vec3(std::uint32_t)> position,
                std::function<void(const MeshBlock&)> emit, std::uint64_t most = kPieceTriangles)
        : position_(std::move(position)), emit_(std::move(emit)), most_(most) {}

    void add(const PieceTriangle& triangle);
    /// After all triangles: vertices that none of them uses, ascending.
    void add_unused(std::uint32_t vertex);
    void finish();

private:
    void emit_triangles();
    void emit_unused();

    std::function<Vec3(std::uint32_t)> position_;
    std::function<void(const MeshBlock&)> emit_;
    std::uint64_t most_;
    std::vector<PieceTriangle> triangles_;
    std::vector<std::uint32_t> unused_;
};

/// Whether a mesh lies whole in one block.
inline bool is_whole(std::uint64_t vertices, std::uint64_t triangles) {
    return std::max(vertices, triangles) <= kLargestWhole;
}

/// Cuts a mesh in memory, or passes it on whole if it is small.
void cut_mesh(const Mesh& mesh, const std::function<void(const MeshBlock&)>& emit);
/// Cuts a mesh however small it is; most: triangles of a piece.
void cut_into_pieces(const Mesh& mesh, std::uint64_t most,
                     const std::function<void(const MeshBlock&)>& emit);

} // namespace abut
